#include "core/unreadable.hpp"

#include "core/nearest.hpp"

#include <cerrno>
#include <cstring>
#include <optional>
#include <system_error>
#include <unistd.h>
#include <vector>

#include <fmt/format.h>

namespace fs = std::filesystem;

namespace flowslide {
namespace {

/// The first folder of the path that is not there; empty if only the file is missing.
fs::path first_missing(const fs::path& path) {
  fs::path sofar;
  std::error_code error;
  for (const fs::path& part : path.parent_path()) {
    sofar /= part;
    if (!fs::exists(sofar, error)) return sofar;
  }
  return {};
}

/// The name in the folder of `path` that its own may have been meant for, told as a question.
std::string near_name(const fs::path& path) {
  // More names than anybody looks through take longer than the message is worth.
  constexpr std::size_t kMostNames = 10000;
  const fs::path folder = path.parent_path().empty() ? "." : path.parent_path();
  std::vector<std::string> names;
  std::error_code error;
  for (fs::directory_iterator it(folder, error), end;
       !error && it != end && names.size() < kMostNames; it.increment(error))
    names.push_back(it->path().filename().string());
  const auto near = nearest(path.filename().string(), names);
  return near ? fmt::format(" Did you mean '{}'?", *near) : "";
}

std::string why_missing(const fs::path& path) {
  const std::string text = path.string();
  if (text.starts_with("~") || text.find("/~") != std::string::npos)
    return "no such file ('~' is not expanded) write the folder in full";
  std::error_code error;
  if (fs::is_symlink(fs::symlink_status(path, error)))
    return fmt::format("is a link to {}, which does not exist",
                       fs::read_symlink(path, error).string());
  const fs::path folder = first_missing(path);
  if (!folder.empty())
    return fmt::format("no such file (the folder {} does not exist).{}", folder.string(),
                       near_name(folder));
  const std::string near = near_name(path);
  return near.empty() ? "no such file" : "no such file." + near;
}

}  // namespace

std::string why_unreadable(const fs::path& path) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (status.type() == fs::file_type::not_found) return why_missing(path);
  if (error) {
    if (error.value() == EACCES)
      return fmt::format("cannot be reached ({}: a folder on the way)", error.message());
    return fmt::format("cannot be reached ({})", error.message());
  }
  if (status.type() == fs::file_type::directory) return "is a folder (a file is expected)";
  if (status.type() != fs::file_type::regular)
    return "is no regular file (a pipe or a device may have no end) copy its content into a file";
  if (::access(path.c_str(), R_OK) != 0)
    return fmt::format("cannot be read ({})", std::strerror(errno));
  return {};
}

}  // namespace flowslide
