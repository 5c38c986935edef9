#include "model/append_file.hpp"

#include "core/check.hpp"

#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <unistd.h>

namespace flowslide {
namespace {

[[noreturn]] void fail(const std::filesystem::path& path, const char* problem) {
  throw FileError(fmt::format("'{}' {} ({})", path.string(), problem, std::strerror(errno)));
}

}  // namespace

AppendFile::AppendFile(const std::filesystem::path& path, std::size_t record_bytes,
                       std::size_t records)
    : path_(path), file_(::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644)) {
  if (file_ < 0) fail(path_, "cannot be opened for writing");
  const off_t size = ::lseek(file_, 0, SEEK_END);
  const off_t wanted = static_cast<off_t>(record_bytes * records);
  if (size < wanted) {
    ::close(file_);
    throw FileError(
        fmt::format("'{}' has {} bytes, but the checkpoint needs {} records of {} bytes (the file "
                    "is older than "
                    "the checkpoint, or was cut off); start the stage again from its beginning",
                    path.string(), size, records, record_bytes));
  }
  if (::ftruncate(file_, wanted) != 0 || ::lseek(file_, wanted, SEEK_SET) != wanted) {
    ::close(file_);
    fail(path_, "cannot be cut back");
  }
}

AppendFile::~AppendFile() { ::close(file_); }

void AppendFile::append(const void* bytes, std::size_t size) {
  const char* from = static_cast<const char*>(bytes);
  while (size > 0) {
    const ssize_t n = ::write(file_, from, size);
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) fail(path_, "cannot be written");
    from += n;
    size -= static_cast<std::size_t>(n);
  }
}

void AppendFile::read(std::size_t offset, void* bytes, std::size_t size) const {
  char* to = static_cast<char*>(bytes);
  while (size > 0) {
    const ssize_t n = ::pread(file_, to, size, static_cast<off_t>(offset));
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) fail(path_, "cannot be read");
    if (n == 0)
      throw FileError(fmt::format("'{}' ends before byte {}", path_.string(), offset + size));
    to += n;
    offset += static_cast<std::size_t>(n);
    size -= static_cast<std::size_t>(n);
  }
}

void AppendFile::sync() {
  if (::fsync(file_) != 0) fail(path_, "cannot be flushed to the disk");
}

}  // namespace flowslide
