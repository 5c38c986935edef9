#include "model/written_fields.hpp"

#include <algorithm>

namespace flowslide {
namespace {

std::size_t size_of(Scalar type) { return H5Tget_size(memory_type(type)); }

}  // namespace

std::size_t WrittenFields::Field::row_bytes() const {
  std::size_t bytes = text_length > 0 ? text_length : size_of(type);
  for (const std::size_t n : row) bytes *= n;
  return bytes;
}

void WrittenFields::add(const std::string& name, Scalar type, std::size_t text_length,
                        std::size_t rows, const Shape& row, const void* data) {
  Field& field = fields_[name];
  field.type = type;
  field.text_length = text_length;
  field.row = row;
  field.rows += rows;
  field.digest.add(data, rows * field.row_bytes());
}

/// In pieces of a chunk's rows. Empty if the dataset has another shape or cannot be read.
std::string WrittenFields::digest_in_file(hid_t dataset, const Field& field) {
  std::vector<hsize_t> wanted{field.rows};
  wanted.insert(wanted.end(), field.row.begin(), field.row.end());
  const auto rank = static_cast<int>(wanted.size());
  const Hdf5Handle space(H5Dget_space(dataset), &H5Sclose);
  std::vector<hsize_t> extent(wanted.size());
  if (H5Sget_simple_extent_ndims(space) != rank ||
      H5Sget_simple_extent_dims(space, extent.data(), nullptr) != rank || extent != wanted)
    return "";
  Sha256 digest;
  const std::size_t row_bytes = field.row_bytes();
  if (field.rows * row_bytes == 0) return digest.hex();

  const Hdf5Handle layout(H5Dget_create_plist(dataset), &H5Pclose);
  std::vector<hsize_t> chunk(wanted.size());
  if (H5Pget_chunk(layout, rank, chunk.data()) != rank) return "";
  const Hdf5Handle type = field.text_length > 0
                              ? text_type(field.text_length)
                              : Hdf5Handle(H5Tcopy(memory_type(field.type)), &H5Tclose);
  std::vector<char> block(std::min<hsize_t>(chunk[0], field.rows) * row_bytes);
  std::vector<hsize_t> start(wanted.size(), 0), count = wanted;
  for (; start[0] < field.rows; start[0] += count[0]) {
    count[0] = std::min<hsize_t>(chunk[0], field.rows - start[0]);
    const Hdf5Handle memory(H5Screate_simple(rank, count.data(), nullptr), &H5Sclose);
    if (H5Sselect_hyperslab(space, H5S_SELECT_SET, start.data(), nullptr, count.data(), nullptr) <
            0 ||
        H5Dread(dataset, type, memory, space, H5P_DEFAULT, block.data()) < 0)
      return "";
    digest.add(block.data(), count[0] * row_bytes);
  }
  return digest.hex();
}

void WrittenFields::compare(const std::filesystem::path& path, const std::filesystem::path& shown) {
  const Hdf5Handle access = file_access();
  Hdf5Handle file(H5Fopen(path.c_str(), H5F_ACC_RDONLY, access), &H5Fclose);
  if (!file.valid()) throw_file_error(shown, "", "cannot be read back; is the disk full?");
  for (auto& [name, field] : fields_) {
    Hdf5Handle dataset(H5Dopen2(file, name.c_str(), H5P_DEFAULT), &H5Dclose);
    if (!dataset.valid()) throw_file_error(shown, name, "is not in the file that was written");
    if (digest_in_file(dataset, field) != field.digest.hex())
      throw_file_error(shown, name,
                       "what is in the file is not what was written; is the disk full or failing?");
    if (dataset.release() < 0) throw_file_error(shown, name, "cannot be closed");
  }
  if (file.release() < 0) throw_file_error(shown, "", "cannot be closed");
}

}  // namespace flowslide
