#include "model/parts_folder.hpp"

#include "core/check.hpp"
#include "core/files.hpp"

#include <system_error>

namespace flowslide {

PartsFolder::PartsFolder(std::filesystem::path path, bool anew) : path_(std::move(path)) {
  path_ += ".partial";
  std::error_code error;
  if (anew) {
    remove_path(path_);
    if (!std::filesystem::create_directory(path_, error) || error)
      throw FileError(
          fmt::format("the folder '{}' cannot be made ({})", path_.string(), error.message()));
    sync_path(path_.parent_path().empty() ? "." : path_.parent_path());
    return;
  }
  // A link would lead the run's writing out of its folder.
  if (own_type_of(path_) != std::filesystem::file_type::directory)
    throw FileError(fmt::format(
        "the folder '{}' is missing (the checkpoint counts on what was in it) delete the "
        "checkpoint to start the stage again from its beginning",
        path_.string()));
  remove_leftovers(path_);
}

void PartsFolder::remove() const { remove_path(path_); }

}  // namespace flowslide
