#include "workflows/engine/run_folder.hpp"

#include "core/check.hpp"
#include "core/files.hpp"
#include "workflows/engine/lock.hpp"
#include "workflows/engine/publish.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

namespace fs = std::filesystem;

namespace flowslide {
namespace {

constexpr std::string_view kGuardFile = ".flowslide.lock";

[[noreturn]] void fail(const fs::path& path, std::string_view problem) {
  throw FileError(fmt::format("{}: {} ({}). Choose another --out.", path.string(), problem,
                              std::strerror(errno)));
}

/// Opens the guard file. A link, or a second name of a file, could lead out of the run folder.
int open_guard(const fs::path& guard) {
  const int file =
      ::open(guard.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK, 0666);
  if (file < 0 && errno == ELOOP)
    throw FileError(fmt::format("'{}' is a link (the run would write where it points). Remove it.",
                                guard.string()));
  if (file < 0) fail(guard, "cannot be written");
  struct stat about {};
  if (::fstat(file, &about) == 0 && S_ISREG(about.st_mode) && about.st_nlink == 1) return file;
  ::close(file);
  throw FileError(
      fmt::format("'{}' is no file of the run folder alone. Remove it.", guard.string()));
}

/// Locks the guard file; false if another process has it.
bool take(int file, const fs::path& guard) {
  while (::flock(file, LOCK_EX | LOCK_NB) != 0) {
    if (errno == EWOULDBLOCK) return false;
    // Some cluster file systems are mounted without locks; there the user has to take care.
    if (errno == ENOSYS || errno == ENOTSUP || errno == ENOLCK) return true;
    if (errno != EINTR) fail(guard, "cannot be locked");
  }
  return true;
}

/// What the process that holds the guard wrote into it.
std::string holder(int guard) {
  std::array<char, 20> text{};
  const ssize_t size = ::pread(guard, text.data(), text.size(), 0);
  std::string digits(text.data(), static_cast<std::size_t>(std::max<ssize_t>(size, 0)));
  std::erase_if(digits, [](unsigned char c) { return !std::isdigit(c); });
  return digits.empty() ? "unknown" : digits;
}

void expect_own_results(const fs::path& folder) {
  if (own_type_of(folder / kGuardFile) != fs::file_type::not_found) return;
  if (own_type_of(folder / kResultFile) == fs::file_type::not_found) return;
  if (read_lock(folder).lock) return;
  throw InputError(
      fmt::format("{}: holds a result.json but no run of flowslide (it would be "
                  "overwritten). Choose another --out.",
                  folder.string()));
}

}  // namespace

RunFolder::RunFolder(fs::path path) : path_(std::move(path)) {
  make_folders(path_);
  expect_own_results(path_);
  const fs::path guard = path_ / kGuardFile;
  lock_ = open_guard(guard);
  try {
    if (!take(lock_, guard))
      throw FileError(
          fmt::format("{}: in use by another run of flowslide (process {}; two would "
                      "spoil each other's files). Wait for it or choose another --out.",
                      path_.string(), holder(lock_)));
    const std::string pid = std::to_string(::getpid());
    if (::ftruncate(lock_, 0) != 0 || ::pwrite(lock_, pid.data(), pid.size(), 0) < 0)
      fail(guard, "cannot be written");
    remove_leftovers(path_);
  } catch (...) {
    ::close(lock_);
    throw;
  }
}

RunFolder::~RunFolder() {
  // The number only means something while it is held.
  [[maybe_unused]] const int ignored = ::ftruncate(lock_, 0);
  ::close(lock_);
}

}  // namespace flowslide
