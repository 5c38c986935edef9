#include "tests/faults/faults.hpp"
#include "tests/faults/unsynced.hpp"

#include <algorithm>
#include <cerrno>
#include <cstdarg>
#include <cstdio>
#include <cstring>
#include <dirent.h>
#include <fcntl.h>
#include <sys/file.h>
#include <sys/sendfile.h>
#include <sys/stat.h>
#include <sys/uio.h>
#include <unistd.h>

/// Calls on files below Plan::root. What the C library calls within itself cannot be seen from
/// here, so streams of <cstdio> are stood in for at fopen, fwrite, fflush and fclose; std::fstream
/// ends in fopen, read, write, writev and fclose. HDF5's driver and zlib call like everybody else.
namespace faults {
namespace {

constexpr int kMostFiles = 4096;
std::atomic<bool> ours[kMostFiles];  ///< by descriptor: whether it lies below the root

bool is_ours(const char* path) {
  if (!armed || plan.memory || !path) return false;
  const std::size_t n = std::strlen(plan.root);
  return std::strncmp(path, plan.root, n) == 0 && (path[n] == '/' || path[n] == 0);
}

bool is_ours(int file) {
  return armed && !plan.memory && file >= 0 && file < kMostFiles && ours[file];
}

/// A path from a folder's descriptor, as the removal of whole folders uses it.
bool is_ours(int folder, const char* path) {
  return path && path[0] == '/' ? is_ours(path) : is_ours(folder);
}

/// errno of a call that is to fail, 0 else.
template <class... Where>
int refused(Call call, int usual, Where... where) {
  return is_ours(where...) ? std::max(0, strike(call, usual)) : 0;
}

int failed(int reason) {
  errno = reason;
  return -1;
}

/// A call that fails with `usual` or is passed on.
template <class F, class... Where>
auto pass(Call call, int usual, F&& real, Where... where) -> decltype(real()) {
  if (const int reason = refused(call, usual, where...)) return failed(reason);
  return real();
}

int opened(int file, int flags) {
  if (file < 0 || file >= kMostFiles) return file;
  ours[file] = true;
  if ((flags & O_ACCMODE) != O_RDONLY) note_open(file);
  return file;
}

template <class F>
int open_as(int folder, const char* path, int flags, F&& real) {
  if (!is_ours(folder, path)) return real();
  // A full disk refuses new names only; strike() takes EMFILE for those.
  const int usual = flags & O_CREAT ? EMFILE : ENFILE;
  if (const int reason = std::max(0, strike(Call::open, usual))) return failed(reason);
  return opened(real(), flags);
}

/// Reads and writes: `real(size)` moves that many bytes.
template <class F>
ssize_t move(Call call, int file, std::size_t size, F&& real) {
  if (!is_ours(file)) return real(size);
  const int reason = strike(call, call == Call::write ? ENOSPC : EIO);
  if (reason > 0) return failed(reason);
  const ssize_t moved = real(reason == 0 ? size : std::max<std::size_t>(1, size / 2));
  if (reason == kTorn) die();
  return moved;
}

FILE* open_stream(const char* path, const char* mode, const char* name) {
  using Open = FILE*(const char*, const char*);
  const bool writes = std::strpbrk(mode, "wa+") != nullptr;
  if (is_ours(path))
    if (const int reason = std::max(0, strike(Call::open, writes ? EMFILE : ENFILE))) {
      errno = reason;
      return nullptr;
    }
  FILE* const stream = next<Open>(name)(path, mode);
  if (stream && is_ours(path)) opened(::fileno(stream), writes ? O_RDWR : O_RDONLY);
  return stream;
}

}  // namespace
}  // namespace faults

using namespace faults;

extern "C" {

int open(const char* path, int flags, ...) {
  va_list rest;
  va_start(rest, flags);
  const mode_t mode = va_arg(rest, mode_t);
  va_end(rest);
  static auto* const real = next<int(const char*, int, ...)>("open");
  return open_as(AT_FDCWD, path, flags, [&] { return real(path, flags, mode); });
}
int open64(const char* path, int flags, ...) {
  va_list rest;
  va_start(rest, flags);
  const mode_t mode = va_arg(rest, mode_t);
  va_end(rest);
  return open(path, flags, mode);
}
int openat(int folder, const char* path, int flags, ...) {
  va_list rest;
  va_start(rest, flags);
  const mode_t mode = va_arg(rest, mode_t);
  va_end(rest);
  static auto* const real = next<int(int, const char*, int, ...)>("openat");
  return open_as(folder, path, flags, [&] { return real(folder, path, flags, mode); });
}
int openat64(int folder, const char* path, int flags, ...) {
  va_list rest;
  va_start(rest, flags);
  const mode_t mode = va_arg(rest, mode_t);
  va_end(rest);
  return openat(folder, path, flags, mode);
}
int creat(const char* path, mode_t mode) { return open(path, O_WRONLY | O_CREAT | O_TRUNC, mode); }
FILE* fopen(const char* path, const char* mode) { return open_stream(path, mode, "fopen"); }
FILE* fopen64(const char* path, const char* mode) { return open_stream(path, mode, "fopen64"); }

int close(int file) {
  static auto* const real = next<int(int)>("close");
  const bool counts = is_ours(file);
  if (file >= 0 && file < kMostFiles) ours[file] = false;
  const int reason = counts ? std::max(0, strike(Call::close, EIO)) : 0;
  const int result = real(file);  // a failed close has closed
  return reason ? failed(reason) : result;
}
int fclose(FILE* stream) {
  static auto* const real = next<int(FILE*)>("fclose");
  const int file = stream ? ::fileno(stream) : -1;
  const bool counts = is_ours(file);
  if (file >= 0 && file < kMostFiles) ours[file] = false;
  const int reason = counts ? std::max(0, strike(Call::close, EIO)) : 0;
  const int result = real(stream);
  return reason ? failed(reason) : result;
}

ssize_t write(int file, const void* bytes, size_t size) {
  static auto* const real = next<ssize_t(int, const void*, size_t)>("write");
  return move(Call::write, file, size, [&](size_t n) { return real(file, bytes, n); });
}
ssize_t pwrite(int file, const void* bytes, size_t size, off_t at) {
  static auto* const real = next<ssize_t(int, const void*, size_t, off_t)>("pwrite");
  return move(Call::write, file, size, [&](size_t n) { return real(file, bytes, n, at); });
}
ssize_t pwrite64(int file, const void* bytes, size_t size, off_t at) {
  return pwrite(file, bytes, size, at);
}
ssize_t writev(int file, const struct iovec* parts, int count) {
  static auto* const real = next<ssize_t(int, const struct iovec*, int)>("writev");
  return move(Call::write, file, static_cast<size_t>(count),
              [&](size_t n) { return real(file, parts, static_cast<int>(n)); });
}
size_t fwrite(const void* bytes, size_t size, size_t count, FILE* stream) {
  static auto* const real = next<size_t(const void*, size_t, size_t, FILE*)>("fwrite");
  const ssize_t moved = move(Call::write, ::fileno(stream), count, [&](size_t n) {
    return static_cast<ssize_t>(real(bytes, size, n, stream));
  });
  return moved < 0 ? 0 : static_cast<size_t>(moved);
}
int fflush(FILE* stream) {
  static auto* const real = next<int(FILE*)>("fflush");
  if (!stream) return real(stream);
  return pass(
      Call::write, ENOSPC, [&] { return real(stream); }, ::fileno(stream));
}
ssize_t sendfile(int out, int in, off_t* at, size_t size) {
  static auto* const real = next<ssize_t(int, int, off_t*, size_t)>("sendfile");
  return move(Call::write, out, size, [&](size_t n) { return real(out, in, at, n); });
}
ssize_t sendfile64(int out, int in, off_t* at, size_t size) { return sendfile(out, in, at, size); }
int ftruncate(int file, off_t size) {
  static auto* const real = next<int(int, off_t)>("ftruncate");
  return static_cast<int>(move(Call::write, file, 0, [&](size_t) { return real(file, size); }));
}
int ftruncate64(int file, off_t size) { return ftruncate(file, size); }

ssize_t read(int file, void* bytes, size_t size) {
  static auto* const real = next<ssize_t(int, void*, size_t)>("read");
  return move(Call::read, file, size, [&](size_t n) { return real(file, bytes, n); });
}
ssize_t pread(int file, void* bytes, size_t size, off_t at) {
  static auto* const real = next<ssize_t(int, void*, size_t, off_t)>("pread");
  return move(Call::read, file, size, [&](size_t n) { return real(file, bytes, n, at); });
}
ssize_t pread64(int file, void* bytes, size_t size, off_t at) {
  return pread(file, bytes, size, at);
}

int fsync(int file) {
  static auto* const real = next<int(int)>("fsync");
  const auto sync = [&] {
    note_sync(file);
    return real(file);
  };
  return pass(Call::sync, EIO, sync, file);
}
int fdatasync(int file) { return fsync(file); }

int rename(const char* from, const char* to) noexcept {
  static auto* const real = next<int(const char*, const char*)>("rename");
  const auto move = [&] {
    if (is_ours(to)) note_rename(AT_FDCWD, from, AT_FDCWD, to);
    return real(from, to);
  };
  return pass(Call::rename, EIO, move, to);
}
int renameat(int a, const char* from, int b, const char* to) noexcept {
  static auto* const real = next<int(int, const char*, int, const char*)>("renameat");
  const auto move = [&] {
    if (is_ours(b, to)) note_rename(a, from, b, to);
    return real(a, from, b, to);
  };
  return pass(Call::rename, EIO, move, b, to);
}
int unlink(const char* path) noexcept {
  static auto* const real = next<int(const char*)>("unlink");
  return pass(
      Call::remove, EIO, [&] { return real(path); }, path);
}
int unlinkat(int folder, const char* path, int flags) noexcept {
  static auto* const real = next<int(int, const char*, int)>("unlinkat");
  return pass(
      Call::remove, EIO, [&] { return real(folder, path, flags); }, folder, path);
}
int rmdir(const char* path) noexcept {
  static auto* const real = next<int(const char*)>("rmdir");
  return pass(
      Call::remove, EIO, [&] { return real(path); }, path);
}
int remove(const char* path) noexcept {
  static auto* const real = next<int(const char*)>("remove");
  return pass(
      Call::remove, EIO, [&] { return real(path); }, path);
}
int mkdir(const char* path, mode_t mode) noexcept {
  static auto* const real = next<int(const char*, mode_t)>("mkdir");
  return pass(
      Call::make, ENOSPC, [&] { return real(path, mode); }, path);
}
int mkdirat(int folder, const char* path, mode_t mode) noexcept {
  static auto* const real = next<int(int, const char*, mode_t)>("mkdirat");
  return pass(
      Call::make, ENOSPC, [&] { return real(folder, path, mode); }, folder, path);
}
int symlink(const char* target, const char* path) noexcept {
  static auto* const real = next<int(const char*, const char*)>("symlink");
  return pass(
      Call::make, ENOSPC, [&] { return real(target, path); }, path);
}
int symlinkat(const char* target, int folder, const char* path) noexcept {
  static auto* const real = next<int(const char*, int, const char*)>("symlinkat");
  return pass(
      Call::make, ENOSPC, [&] { return real(target, folder, path); }, folder, path);
}

int stat(const char* path, struct stat* about) noexcept {
  static auto* const real = next<int(const char*, struct stat*)>("stat");
  return pass(
      Call::look, EIO, [&] { return real(path, about); }, path);
}
int lstat(const char* path, struct stat* about) noexcept {
  static auto* const real = next<int(const char*, struct stat*)>("lstat");
  return pass(
      Call::look, EIO, [&] { return real(path, about); }, path);
}
int fstat(int file, struct stat* about) noexcept {
  static auto* const real = next<int(int, struct stat*)>("fstat");
  return pass(
      Call::look, EIO, [&] { return real(file, about); }, file);
}
int fstatat(int folder, const char* path, struct stat* about, int flags) noexcept {
  static auto* const real = next<int(int, const char*, struct stat*, int)>("fstatat");
  return pass(
      Call::look, EIO, [&] { return real(folder, path, about, flags); }, folder, path);
}
// The same structures on 64-bit Linux.
int stat64(const char* path, struct stat64* about) noexcept {
  return stat(path, reinterpret_cast<struct stat*>(about));
}
int lstat64(const char* path, struct stat64* about) noexcept {
  return lstat(path, reinterpret_cast<struct stat*>(about));
}
int fstat64(int file, struct stat64* about) noexcept {
  return fstat(file, reinterpret_cast<struct stat*>(about));
}
int fstatat64(int folder, const char* path, struct stat64* about, int flags) noexcept {
  return fstatat(folder, path, reinterpret_cast<struct stat*>(about), flags);
}
ssize_t readlink(const char* path, char* target, size_t size) noexcept {
  static auto* const real = next<ssize_t(const char*, char*, size_t)>("readlink");
  return pass(
      Call::look, EIO, [&] { return real(path, target, size); }, path);
}
DIR* opendir(const char* path) {
  static auto* const real = next<DIR*(const char*)>("opendir");
  if (const int reason = refused(Call::look, EIO, path)) {
    errno = reason;
    return nullptr;
  }
  DIR* const listing = real(path);
  if (listing && is_ours(path)) opened(::dirfd(listing), O_RDONLY);
  return listing;
}
struct dirent* readdir(DIR* listing) {
  static auto* const real = next<struct dirent*(DIR*)>("readdir");
  if (const int reason = refused(Call::look, EIO, ::dirfd(listing))) {
    errno = reason;
    return nullptr;
  }
  return real(listing);
}
struct dirent64* readdir64(DIR* listing) {
  return reinterpret_cast<struct dirent64*>(readdir(listing));
}
off_t lseek(int file, off_t offset, int from) noexcept {
  static auto* const real = next<off_t(int, off_t, int)>("lseek");
  return pass(
      Call::look, EIO, [&] { return real(file, offset, from); }, file);
}
off64_t lseek64(int file, off64_t offset, int from) noexcept { return lseek(file, offset, from); }
int flock(int file, int how) noexcept {
  static auto* const real = next<int(int, int)>("flock");
  return pass(
      Call::look, EIO, [&] { return real(file, how); }, file);
}
int chmod(const char* path, mode_t mode) noexcept {
  static auto* const real = next<int(const char*, mode_t)>("chmod");
  return pass(
      Call::look, EIO, [&] { return real(path, mode); }, path);
}
}
