#include "workflows/engine/run_folder.hpp"

#include "core/check.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <fstream>
#include <sstream>
#include <sys/file.h>
#include <unistd.h>

#include <fmt/format.h>

namespace fs = std::filesystem;

namespace flowslide {
namespace {

constexpr std::string_view kGuardFile = ".flowslide.lock";

std::string read_all(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  if (!in) throw FileError(fmt::format("{}: cannot be read", path.string()));
  std::ostringstream out;
  out << in.rdbuf();
  return out.str();
}

std::string replace_all(std::string text, std::string_view from, const std::string& to) {
  for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size())
    text.replace(at, from.size(), to);
  return text;
}

/// Locks the guard file; false if another process has it.
bool take(int file, const fs::path& guard) {
  while (::flock(file, LOCK_EX | LOCK_NB) != 0) {
    if (errno == EWOULDBLOCK) return false;
    // Some cluster file systems are mounted without locks; there the user has to take care.
    if (errno == ENOSYS || errno == ENOTSUP || errno == ENOLCK) return true;
    if (errno != EINTR)
      throw FileError(
          fmt::format("{}: cannot be locked ({})", guard.string(), std::strerror(errno)));
  }
  return true;
}

}  // namespace

RunFolder::RunFolder(fs::path path) : path_(std::move(path)) {
  std::error_code error;
  fs::create_directories(path_, error);
  if (!fs::is_directory(path_))
    throw FileError(fmt::format("{}: cannot be made a folder ({}). Choose another --out.",
                                path_.string(), error ? error.message() : "a file has this name"));
  const fs::path guard = path_ / kGuardFile;
  const bool known = fs::exists(guard) || read_lock(path_);
  if (!known && fs::exists(path_ / kResultFile))
    throw InputError(
        fmt::format("{}: holds a result.json but no run of flowslide (it would be "
                    "overwritten). Choose another --out.",
                    path_.string()));
  lock_ = ::open(guard.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  if (lock_ < 0)
    throw FileError(fmt::format("{}: cannot be written ({}). Choose another --out.", path_.string(),
                                std::strerror(errno)));
  bool mine = false;
  try {
    mine = take(lock_, guard);
  } catch (...) {
    ::close(lock_);
    throw;
  }
  if (!mine) {
    ::close(lock_);
    throw FileError(
        fmt::format("{}: in use by another run of flowslide (process {}; two would "
                    "spoil each other's files). Wait for it or choose another --out.",
                    path_.string(), read_all(guard)));
  }
  const std::string pid = std::to_string(::getpid());
  if (::ftruncate(lock_, 0) != 0 || ::pwrite(lock_, pid.data(), pid.size(), 0) < 0) {
    ::close(lock_);
    throw FileError(
        fmt::format("{}: cannot be written ({})", guard.string(), std::strerror(errno)));
  }
}

RunFolder::~RunFolder() { ::close(lock_); }

void RunFolder::withdraw() const {
  std::error_code ignored;
  fs::remove(path_ / kResultFile, ignored);
  if (fs::exists(path_ / kResultFile))
    throw FileError(fmt::format("{}: an old result.json cannot be removed", path_.string()));
  const auto lock = read_lock(path_);
  if (!lock) return;
  for (const std::string& name : lock->published) {
    const fs::path link = path_ / name;
    if (fs::is_symlink(link) || link.extension() == ".pvd") fs::remove(link, ignored);
  }
}

void RunFolder::publish(const Publication& item) const {
  const fs::path link = path_ / item.name;
  std::error_code error;
  if (link.extension() == ".pvd") {
    const std::string text = read_all(path_ / item.target);
    const std::string prefix = item.target.parent_path().generic_string() + "/";
    write_atomically(link, replace_all(text, "file=\"", "file=\"" + prefix));
    return;
  }
  if (fs::is_symlink(link)) fs::remove(link, error);
  fs::create_symlink(item.target, link, error);
  if (error)
    throw FileError(fmt::format("{}: cannot be made ({})", link.string(), error.message()));
}

std::vector<Publication> publications(const std::vector<StageRecord>& records) {
  std::vector<Publication> items;
  for (const StageRecord& record : records) {
    for (const std::string& file : record.publish) {
      std::string name = fs::path(file).filename().string();
      const bool taken = std::any_of(items.begin(), items.end(),
                                     [&](const Publication& p) { return p.name == name; });
      if (taken) name = record.stage + "." + name;
      items.push_back({name, result_folder({}, record.stage, record.key) / file});
    }
  }
  return items;
}

fs::path result_folder(const fs::path& run_folder, const std::string& stage,
                       const std::string& key) {
  return run_folder / "stages" / stage / key.substr(0, 16);
}

fs::path work_folder(const fs::path& run_folder, const std::string& stage, const std::string& key) {
  return result_folder(run_folder, stage, key).string() + ".partial";
}

void discard_result(const fs::path& result) {
  fs::remove(result / kRecordFile);
  fs::remove_all(result);
}

}  // namespace flowslide
