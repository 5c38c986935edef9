#include "study/run/locks.hpp"

#include "core/check.hpp"

#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <unistd.h>

namespace flowslide::study {
namespace {

/// One byte of the file stands for a key: the first 60 bits of it are its place.
struct flock range(const std::string& key, short kind) {
  constexpr std::size_t kDigits = 15;
  struct flock lock {};
  lock.l_type = kind;
  lock.l_whence = SEEK_SET;
  lock.l_start = static_cast<off_t>(std::stoull(key.substr(0, kDigits), nullptr, 16));
  lock.l_len = 1;
  return lock;
}

}  // namespace

Locks::Locks(const std::filesystem::path& folder) : path_(folder / ".locks") {
  file_ = ::open(path_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0666);
  if (file_ < 0)
    throw FileError(fmt::format("{}: cannot be written ({}). Choose another --out.", path_.string(),
                                std::strerror(errno)));
}

Locks::~Locks() { ::close(file_); }

bool Locks::set(const std::string& key, short kind) {
  struct flock lock = range(key, kind);
  while (::fcntl(file_, F_OFD_SETLK, &lock) != 0) {
    if (errno == EAGAIN || errno == EACCES) return false;
    // Some cluster file systems are mounted without locks; there the user has to take care.
    if (errno == ENOLCK || errno == ENOSYS || errno == EOPNOTSUPP || errno == EINVAL) return true;
    if (errno != EINTR)
      throw FileError(
          fmt::format("{}: cannot be locked ({})", path_.string(), std::strerror(errno)));
  }
  return true;
}

bool Locks::take_shared(const std::string& key) { return set(key, F_RDLCK); }
bool Locks::take(const std::string& key) { return set(key, F_WRLCK); }
void Locks::release(const std::string& key) { (void)set(key, F_UNLCK); }

bool Locks::is_taken(const std::string& key) const {
  struct flock lock = range(key, F_WRLCK);
  return ::fcntl(file_, F_OFD_GETLK, &lock) == 0 && lock.l_type != F_UNLCK;
}

}  // namespace flowslide::study
