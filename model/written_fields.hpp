#pragma once
#include "core/hash.hpp"
#include "model/hdf5_handle.hpp"

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace flowslide {

/// What a writer gave to HDF5, for comparison with what is in the file. HDF5 writes a chunk when it
/// needs the room or closes the dataset; one that is lost reads back as zeros, and no checksum
/// tells. Private to this module.
class WrittenFields {
 public:
  /// Rows that go to the end of a dataset, whose other extents are `row`. `text_length` is that of
  /// fixed texts, 0 for numbers.
  void add(const std::string& name, Scalar type, std::size_t text_length, std::size_t rows,
           const Shape& row, const void* data);
  /// Reads everything again, every chunk once. `shown` is the name for messages. Throws FileError.
  /// Once.
  void compare(const std::filesystem::path& file, const std::filesystem::path& shown);

 private:
  struct Field {
    Scalar type = Scalar::f64;
    std::size_t text_length = 0;
    std::size_t rows = 0;
    Shape row;
    Sha256 digest;
    [[nodiscard]] std::size_t row_bytes() const;
  };
  static std::string digest_in_file(hid_t dataset, const Field& field);
  std::map<std::string, Field> fields_;
};

}  // namespace flowslide
