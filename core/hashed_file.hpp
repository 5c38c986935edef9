#pragma once
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>

/// Files that are looked at twice: when their content is taken as the key of a result, and again
/// when the result is there.
namespace flowslide {

/// What the system says of a file without reading it. Equal states mean that nothing has written,
/// replaced or restored the file in between: unlike the time of the last change of its content,
/// `changed` cannot be set back. Holds over a restart of the machine.
struct FileState {
  std::uint64_t inode = 0;
  std::uint64_t size = 0;
  std::int64_t modified = 0;  ///< [ns] last change of the content
  std::int64_t changed = 0;   ///< [ns] last change of content, name, owner or times
  bool operator==(const FileState&) const = default;
};

/// State of the file that the path leads to. Throws FileError.
FileState file_state(const std::filesystem::path& path);

struct HashedFile {
  std::filesystem::path path;
  std::string sha256;
  FileState state;
};

/// Called between the blocks of a long file; may throw.
using Between = std::function<void()>;

/// Throws FileError for what is no regular file, and if the file changes meanwhile.
HashedFile hash_file(
    const std::filesystem::path& path, const Between& between = [] {});

/// FileError if the file has been written or replaced since, even if its content is the old one
/// again: who read it in between may have read something else.
void expect_same_state(const HashedFile& file);

/// The same, and reads the content again.
void expect_unchanged(const HashedFile& file);

}  // namespace flowslide
