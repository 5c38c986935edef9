#include "workflows/engine/result_folder.hpp"

#include "core/check.hpp"
#include "core/files.hpp"

#include <cstdio>
#include <fcntl.h>
#include <optional>

namespace fs = std::filesystem;

namespace flowslide {
namespace {

/// The first link on the way from the run folder, itself left out, to a folder in it.
std::optional<fs::path> link_between(const fs::path& run_folder, const fs::path& folder) {
  fs::path path = run_folder;
  for (const fs::path& part : folder.lexically_relative(run_folder))
    if (own_type_of(path /= part) == fs::file_type::symlink) return path;
  return std::nullopt;
}

}  // namespace

fs::path result_folder(const fs::path& run_folder, const std::string& stage,
                       const std::string& key) {
  return run_folder / "stages" / stage / key.substr(0, 16);
}

fs::path work_folder(const fs::path& run_folder, const std::string& stage, const std::string& key) {
  return result_folder(run_folder, stage, key).string() + ".partial";
}

void make_work_folder(const fs::path& run_folder, const fs::path& work, bool keep) {
  if (const auto link = link_between(run_folder, work.parent_path()))
    throw FileError(
        fmt::format("'{}' is a link (results would be written outside the run "
                    "folder). Remove it, or make the run folder itself the link.",
                    link->string()));
  if (!keep) remove_path(work);
  make_folders(work);
}

void remove_work_folder(const fs::path& run_folder, const fs::path& work) {
  if (own_type_of(work) != fs::file_type::not_found &&
      !link_between(run_folder, work.parent_path()))
    remove_path(work);
}

void install_result(const fs::path& work, const fs::path& result) {
  sync_tree(work);
  if (own_type_of(result) == fs::file_type::not_found) {
    rename_durably(work, result);
    return;
  }
  if (::renameat2(AT_FDCWD, work.c_str(), AT_FDCWD, result.c_str(), RENAME_EXCHANGE) == 0) {
    sync_path(result.parent_path());
    remove_path(work);
    return;
  }
  // Some network disks cannot exchange two names; there nothing is under the name for a moment.
  const fs::path former = result.string() + ".former";
  remove_path(former);
  rename_durably(result, former);
  rename_durably(work, result);
  remove_path(former);
}

}  // namespace flowslide
