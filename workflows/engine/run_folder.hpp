#pragma once
#include "workflows/engine/record.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace flowslide {

inline constexpr std::string_view kResultFile = "result.json";

/// Something of a stage that appears at the top of the run folder.
struct Publication {
  std::string name;              ///< at the top
  std::filesystem::path target;  ///< relative to the run folder
};

/// What the results publish; a name that is taken gets the stage's name in front.
std::vector<Publication> publications(const std::vector<StageRecord>& records);

/// The right to write into a run folder, held until destruction; ends with the process however
/// it ends.
class RunFolder {
 public:
  /// Creates the folder if it is not there. Throws FileError if another process holds it or it
  /// cannot be written, InputError if it holds a result.json that is not from this program.
  explicit RunFolder(std::filesystem::path path);
  ~RunFolder();
  RunFolder(const RunFolder&) = delete;
  RunFolder& operator=(const RunFolder&) = delete;

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

  /// Removes result.json and what earlier results have published, so that nothing at the top looks
  /// current while it is not.
  void withdraw() const;

  /// Makes a relative link at the top. A .pvd is copied and the paths inside are rewritten, since
  /// ParaView reads them from where the .pvd lies. Throws FileError.
  void publish(const Publication& item) const;

 private:
  std::filesystem::path path_;
  int lock_ = -1;
};

/// DIR/stages/<stage>/<first 16 digits of the key>
std::filesystem::path result_folder(const std::filesystem::path& run_folder,
                                    const std::string& stage, const std::string& key);

/// The same with ".partial": where a stage works until it is complete.
std::filesystem::path work_folder(const std::filesystem::path& run_folder, const std::string& stage,
                                  const std::string& key);

/// Removes a result that is no longer valid; what is left after a kill half-way is no result.
void discard_result(const std::filesystem::path& result);

}  // namespace flowslide
