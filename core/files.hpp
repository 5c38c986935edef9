#pragma once
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

/// The one way in which the program writes, replaces and removes files. Every system call is
/// checked, links are never followed for writing, and a file under its final name is complete and
/// on the disk: after a power cut the old or the new is there. Everything throws FileError with the
/// system's reason.
namespace flowslide {

/// A name beside `path` that nothing has: ".NAME.<random>.partial". What killed writers of the same
/// file left under such names goes. FileError for what is a pipe or a device.
std::filesystem::path temporary_name(const std::filesystem::path& path);

/// Bytes that appear under `path` when all of them are on the disk. The destructor only cleans up:
/// what has not been committed is gone.
class OutputFile {
 public:
  explicit OutputFile(std::filesystem::path path);
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  void write(const void* bytes, std::size_t size);
  void write(std::string_view text) { write(text.data(), text.size()); }
  /// Syncs, closes, renames, syncs the folder. Once, after the last byte.
  void commit();

 private:
  std::filesystem::path path_, temporary_;
  std::string buffer_;
  int file_ = -1;
  void flush();
  void put(const char* bytes, std::size_t size);
};

/// OutputFile for bytes that are there already.
void write_file(const std::filesystem::path& path, std::string_view bytes);

/// Hands the content of a regular file to `take`, block by block, whatever its size. FileError for
/// anything else; what `take` throws goes through.
void read_blocks(const std::filesystem::path& path,
                 const std::function<void(std::string_view block)>& take);

/// Whole content of a regular file. FileError for anything else (folder, pipe, device: they may
/// have no end) and for more than `limit` bytes.
std::string read_file(const std::filesystem::path& path, std::uint64_t limit);

/// What is under a name, `not_found` if nothing is; a link counts as what it points to. FileError
/// where the system does not tell: what cannot be looked at is not absent.
std::filesystem::file_type type_of(const std::filesystem::path& path);

/// type_of() of the name itself: a link is a link.
std::filesystem::file_type own_type_of(const std::filesystem::path& path);

inline bool is_there(const std::filesystem::path& path) {
  return type_of(path) != std::filesystem::file_type::not_found;
}

/// FileError unless `path` is a regular file, or a link to one, that can be read.
void expect_regular_file(const std::filesystem::path& path);

/// Content of a file or entries of a folder go to the disk.
void sync_path(const std::filesystem::path& path);

/// Syncs what a folder holds, files and folders, from the bottom up.
void sync_tree(const std::filesystem::path& folder);

/// Replaces `to`, then syncs the folders of both.
void rename_durably(const std::filesystem::path& from, const std::filesystem::path& to);

/// Makes a folder and those above it, on the disk too.
void make_folders(const std::filesystem::path& folder);

/// Removes a file, a link (not what it points to) or a folder with what it holds; nothing there is
/// no error.
void remove_path(const std::filesystem::path& path);

/// Removes what killed writers left in a folder: temporary names, as temporary_name() makes them.
void remove_leftovers(const std::filesystem::path& folder);

}  // namespace flowslide
