#include "model/append_file.hpp"

#include "core/check.hpp"
#include "core/files.hpp"
#include "core/hash.hpp"

#include <cerrno>
#include <cstdint>
#include <cstring>
#include <fcntl.h>
#include <limits>
#include <sys/stat.h>
#include <unistd.h>

namespace flowslide {
namespace {

constexpr const char* kStartAgain =
    "delete the checkpoint to start the stage again from its beginning";

[[noreturn]] void fail(const std::filesystem::path& path, const char* problem, int reason) {
  throw FileError(fmt::format("'{}' {} ({})", path.string(), problem, std::strerror(reason)));
}

void write_whole(const std::filesystem::path& path, int file, const void* bytes, std::size_t size) {
  const char* from = static_cast<const char*>(bytes);
  while (size > 0) {
    const ssize_t n = ::write(file, from, size);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) fail(path, "cannot be written; is the disk full?", n < 0 ? errno : ENOSPC);
    from += n;
    size -= static_cast<std::size_t>(n);
  }
}

void read_whole(const std::filesystem::path& path, int file, std::size_t offset, void* bytes,
                std::size_t size) {
  char* to = static_cast<char*>(bytes);
  while (size > 0) {
    const ssize_t n = ::pread(file, to, size, static_cast<off_t>(offset));
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) fail(path, "cannot be read", errno);
    if (n == 0)
      throw FileError(fmt::format("'{}' ends before byte {} (it was cut off) {}", path.string(),
                                  offset + size, kStartAgain));
    to += n;
    offset += static_cast<std::size_t>(n);
    size -= static_cast<std::size_t>(n);
  }
}

}  // namespace

AppendFile::AppendFile(std::filesystem::path path, std::size_t record_bytes, std::size_t keep)
    : path_(std::move(path)), record_bytes_(record_bytes) {
  try {
    if (keep == 0)
      open_anew();
    else
      reopen(keep);
  } catch (...) {
    if (file_ >= 0) ::close(file_);
    throw;
  }
}

AppendFile::~AppendFile() { ::close(file_); }

void AppendFile::open_anew() {
  remove_path(path_);
  file_ = ::open(path_.c_str(), O_RDWR | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666);
  if (file_ < 0) fail(path_, "cannot be made", errno);
  sync_path(path_.parent_path().empty() ? "." : path_.parent_path());
}

void AppendFile::reopen(std::size_t keep) {
  file_ = ::open(path_.c_str(), O_RDWR | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
  if (file_ < 0) fail(path_, "cannot be opened for writing", errno);
  struct stat about {};
  if (::fstat(file_, &about) != 0) fail(path_, "cannot be opened for writing", errno);
  const std::size_t step = record_bytes_ + kSha256Digits;
  if (!S_ISREG(about.st_mode) || keep > static_cast<std::size_t>(about.st_size) / step)
    throw FileError(fmt::format(
        "'{}' has {} bytes, but the checkpoint needs {} records of {} bytes (the file is older "
        "than the checkpoint, or was cut off) {}",
        path_.string(), about.st_size, keep, step, kStartAgain));
  std::vector<char> record(record_bytes_);
  for (size_ = keep; keep > 0; --keep) read(size_ - keep, record.data());
  const auto end = static_cast<off_t>(step * size_);
  if (::ftruncate(file_, end) != 0 || ::lseek(file_, end, SEEK_SET) != end)
    fail(path_, "cannot be cut back", errno);
}

std::string AppendFile::checksum(std::size_t index, const void* record) const {
  Sha256 digest;
  const std::uint64_t number = index;
  digest.add(&number, sizeof number);
  digest.add(record, record_bytes_);
  return digest.hex();
}

void AppendFile::append(const void* record) {
  write_whole(path_, file_, record, record_bytes_);
  write_whole(path_, file_, checksum(size_, record).data(), kSha256Digits);
  ++size_;
}

void AppendFile::read(std::size_t index, void* record) const {
  FLOWSLIDE_EXPECT(index < size_);
  const std::size_t offset = index * (record_bytes_ + kSha256Digits);
  std::string stored(kSha256Digits, ' ');
  read_whole(path_, file_, offset, record, record_bytes_);
  read_whole(path_, file_, offset + record_bytes_, stored.data(), kSha256Digits);
  if (stored != checksum(index, record))
    throw FileError(
        fmt::format("'{}': record {} is not what was written (its checksum does not fit its bytes: "
                    "the file is damaged) {}",
                    path_.string(), index, kStartAgain));
}

void AppendFile::sync() {
  if (::fsync(file_) != 0) fail(path_, "cannot be flushed to the disk", errno);
}

}  // namespace flowslide
