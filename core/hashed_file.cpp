#include "core/hashed_file.hpp"

#include "core/check.hpp"
#include "core/files.hpp"
#include "core/hash.hpp"

#include <cerrno>
#include <cstring>
#include <sys/stat.h>

namespace flowslide {
namespace {

std::int64_t nanoseconds(const timespec& time) {
  return static_cast<std::int64_t>(time.tv_sec) * 1'000'000'000 + time.tv_nsec;
}

[[noreturn]] void has_changed(const std::filesystem::path& path) {
  throw FileError(fmt::format(
      "'{}' was changed while it was in use (a result could come from what it held in between). "
      "Run again when nothing writes it.",
      path.string()));
}

}  // namespace

FileState file_state(const std::filesystem::path& path) {
  struct stat about {};
  if (::stat(path.c_str(), &about) != 0)
    throw FileError(fmt::format("'{}' cannot be read ({})", path.string(), std::strerror(errno)));
  return {.inode = about.st_ino,
          .size = static_cast<std::uint64_t>(about.st_size),
          .modified = nanoseconds(about.st_mtim),
          .changed = nanoseconds(about.st_ctim)};
}

HashedFile hash_file(const std::filesystem::path& path, const Between& between) {
  HashedFile file{.path = path, .sha256 = {}, .state = file_state(path)};
  Sha256 digest;
  read_blocks(path, [&](std::string_view block) {
    digest.add(block.data(), block.size());
    between();
  });
  file.sha256 = digest.hex();
  expect_same_state(file);
  return file;
}

void expect_same_state(const HashedFile& file) {
  if (file_state(file.path) != file.state) has_changed(file.path);
}

void expect_unchanged(const HashedFile& file) {
  expect_same_state(file);
  // Two changes within one tick of the file system's clock have one time.
  if (hash_file(file.path).sha256 != file.sha256) has_changed(file.path);
}

}  // namespace flowslide
