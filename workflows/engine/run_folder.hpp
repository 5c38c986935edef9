#pragma once
#include <filesystem>

namespace flowslide {

/// The right to write into a run folder, held until destruction; ends with the process however
/// it ends.
class RunFolder {
 public:
  /// Creates the folder if it is not there, and removes what killed writers left at its top. Throws
  /// FileError if another process holds it or it cannot be written, InputError if it holds a
  /// result.json that is not from this program.
  explicit RunFolder(std::filesystem::path path);
  ~RunFolder();
  RunFolder(const RunFolder&) = delete;
  RunFolder& operator=(const RunFolder&) = delete;

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
  int lock_ = -1;
};

}  // namespace flowslide
