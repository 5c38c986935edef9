#pragma once
#include <cstddef>
#include <filesystem>

namespace flowslide {

/// Binary file of records of one size that only grows; a killed program leaves at worst a part of
/// the last record. Throws FileError.
class AppendFile {
 public:
  /// Opens or creates; keeps the first `records` records and cuts off the rest. Fewer than
  /// `records` in the file is an error.
  AppendFile(const std::filesystem::path& path, std::size_t record_bytes, std::size_t records);
  ~AppendFile();
  AppendFile(const AppendFile&) = delete;
  AppendFile& operator=(const AppendFile&) = delete;

  void append(const void* bytes, std::size_t size);
  /// Reads from byte `offset`; the range must have been written.
  void read(std::size_t offset, void* bytes, std::size_t size) const;
  /// Data reach the disk.
  void sync();

 private:
  std::filesystem::path path_;
  int file_ = -1;
};

}  // namespace flowslide
