#pragma once
#include <filesystem>
#include <string>

namespace flowslide {

/// The folder `path`.partial in which the parts of a file lie while a run makes it. It stays until
/// it is removed: a killed run continues with it. Private to this module. Throws FileError.
class PartsFolder {
 public:
  /// Made anew, or as an earlier run left it.
  PartsFolder(std::filesystem::path path, bool anew);
  [[nodiscard]] std::filesystem::path operator/(const char* name) const { return path_ / name; }
  void remove() const;

 private:
  std::filesystem::path path_;
};

}  // namespace flowslide
