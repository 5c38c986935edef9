#pragma once
#include "core/check.hpp"

#include <cstdlib>
#include <filesystem>

namespace flowslide {

/// An empty folder that goes, with what is in it, at the end of its scope. Throws FileError.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "flowslide-XXXXXX").string();
    if (!::mkdtemp(name.data())) throw FileError("the folder '" + name + "' cannot be made");
    path_ = name;
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  [[nodiscard]] std::filesystem::path operator/(const char* name) const { return path_ / name; }
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace flowslide
