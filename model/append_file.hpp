#pragma once
#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace flowslide {

/// Binary file of records of one size that only grows; a killed program leaves at worst a part of
/// the last record. Behind each record stands the SHA-256 of its number and its bytes, and nothing
/// is read that does not fit it. Throws FileError.
class AppendFile {
 public:
  /// With `keep` of 0 makes the file anew. Otherwise opens it, compares the first `keep` records
  /// with their checksums and cuts off what comes behind; fewer records in the file are an error.
  AppendFile(std::filesystem::path path, std::size_t record_bytes, std::size_t keep);
  ~AppendFile();
  AppendFile(const AppendFile&) = delete;
  AppendFile& operator=(const AppendFile&) = delete;

  void append(const void* record);
  /// A record that has been written.
  void read(std::size_t index, void* record) const;
  [[nodiscard]] std::size_t size() const { return size_; }
  /// Records reach the disk.
  void sync();

 private:
  [[nodiscard]] std::string checksum(std::size_t index, const void* record) const;
  void open_anew();
  void reopen(std::size_t keep);
  std::filesystem::path path_;
  std::size_t record_bytes_, size_ = 0;
  int file_ = -1;
};

}  // namespace flowslide
