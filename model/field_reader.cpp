#include "core/files.hpp"
#include "model/field_store.hpp"
#include "model/hdf5_handle.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <set>

namespace flowslide {
namespace {

constexpr std::string_view kSignature("\x89HDF\r\n\x1a\n", 8);
constexpr std::string_view kLfsPointer = "version https://git-lfs";
/// Deflate cannot shrink data further than 1032:1, so a larger array cannot be in the file.
constexpr double kMaxCompression = 1032.0;

constexpr std::size_t kLongestText = 4096;  ///< of a root attribute; a damaged type may claim GiB

/// The file's size, after telling apart what HDF5 itself only calls "file signature not found".
std::uintmax_t check_signature(const std::filesystem::path& path) {
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(path, error);
  if (status.type() == std::filesystem::file_type::not_found)
    throw FileError(fmt::format("'{}' does not exist", path.string()));
  if (error)
    throw FileError(fmt::format("'{}' cannot be read ({})", path.string(), error.message()));
  expect_regular_file(path);
  std::ifstream in(path, std::ios::binary);
  if (!in)
    throw FileError(fmt::format("'{}' cannot be read; check its permissions", path.string()));
  std::string head(kLfsPointer.size(), '\0');
  in.read(head.data(), static_cast<std::streamsize>(head.size()));
  head.resize(static_cast<std::size_t>(in.gcount()));
  if (head.empty())
    throw FileError(fmt::format(
        "'{}' is empty (the program that wrote it was stopped, or a copy failed); make it again",
        path.string()));
  if (head == kLfsPointer)
    throw FileError(fmt::format(
        "'{}' is a git-LFS pointer (the data themselves were not downloaded); run 'git lfs pull'",
        path.string()));
  if (!head.starts_with(kSignature))
    throw FileError(fmt::format("'{}' is not an HDF5 file (its first bytes are another format's)",
                                path.string()));
  const std::uintmax_t size = std::filesystem::file_size(path, error);
  return error ? 0 : size;
}

Hdf5Handle open_file(const std::filesystem::path& path) {
  const Hdf5Handle access = file_access();
  Hdf5Handle file(H5Fopen(path.c_str(), H5F_ACC_RDONLY, access), &H5Fclose);
  if (!file.valid()) {
    const bool cut = hdf5_error().find("truncated") != std::string::npos;
    throw_file_error(
        path, "",
        cut ? "the file is cut off (a copy or a run stopped half-way); copy or make it "
              "again"
            : "cannot be opened as HDF5; the file is damaged, copy or make it again");
  }
  return file;
}

std::string trimmed(std::string text) {
  text.resize(text.find_last_not_of('\0') + 1);
  return text;
}

/// Text of a root attribute, empty if there is none.
std::string root_text(const std::filesystem::path& path, hid_t file, const char* name) {
  const htri_t there = H5Aexists(file, name);
  if (there == 0) return "";
  const Hdf5Handle attribute(H5Aopen(file, name, H5P_DEFAULT), &H5Aclose);
  const Hdf5Handle type(H5Aget_type(attribute), &H5Tclose);
  const Hdf5Handle space(H5Aget_space(attribute), &H5Sclose);
  // A disk that refuses to be read is not a file without the attribute.
  if (there < 0 || !attribute.valid() || !type.valid() || !space.valid())
    throw_file_error(path, "", fmt::format("attribute '{}' cannot be read", name));
  if (H5Tget_class(type) != H5T_STRING || H5Tis_variable_str(type) > 0 ||
      H5Tget_size(type) > kLongestText || H5Sget_simple_extent_npoints(space) != 1)
    return "";
  std::string text(H5Tget_size(type), '\0');
  if (H5Aread(attribute, type, text.data()) < 0)
    throw_file_error(path, "", fmt::format("attribute '{}' cannot be read", name));
  return trimmed(text);
}

std::int64_t root_integer(const std::filesystem::path& path, hid_t file, const char* name) {
  std::int64_t value = 0;
  const Hdf5Handle attribute(H5Aopen(file, name, H5P_DEFAULT), &H5Aclose);
  const Hdf5Handle space(H5Aget_space(attribute), &H5Sclose);
  if (!attribute.valid() || H5Sget_simple_extent_npoints(space) != 1 ||
      H5Aread(attribute, H5T_NATIVE_INT64, &value) < 0)
    throw_file_error(path, "", fmt::format("attribute '{}' cannot be read", name));
  return value;
}

template <class Int>
void narrow(const std::string& where, const std::vector<std::int64_t>& wide, void* data) {
  Int* out = static_cast<Int*>(data);
  for (std::size_t i = 0; i < wide.size(); ++i) {
    validate(
        wide[i] >= std::numeric_limits<Int>::min() && wide[i] <= std::numeric_limits<Int>::max(),
        "{}: value {} is {} (it must lie between {} and {})", where, i, wide[i],
        std::numeric_limits<Int>::min(), std::numeric_limits<Int>::max());
    out[i] = static_cast<Int>(wide[i]);
  }
}

/// validate() for what HDF5 has told of the file.
template <class... Args>
void demand(const std::filesystem::path& path, bool ok, fmt::format_string<Args...> text,
            Args&&... args) {
  if (ok) return;
  expect_no_system_error(path);
  throw InputError(fmt::format(text, std::forward<Args>(args)...));
}

}  // namespace

struct FieldReader::Impl {
  std::filesystem::path path;
  Hdf5Handle file;
  std::uintmax_t file_size = 0;
  mutable std::set<std::string> complete;  ///< datasets all of whose chunks are there

  [[nodiscard]] std::string where(const std::string& name) const {
    return fmt::format("'{}': dataset '{}'", path.string(), name);
  }

  /// Every step of the name exists and is a hard link.
  [[nodiscard]] bool reachable(const std::string& name) const {
    for (std::size_t end = 0; end != std::string::npos;) {
      end = name.find('/', end + 1);
      const std::string prefix = name.substr(0, end);
      if (H5Lexists(file, prefix.c_str(), H5P_DEFAULT) <= 0) {
        expect_no_system_error(path);
        return false;
      }
      H5L_info_t info;
      if (H5Lget_info(file, prefix.c_str(), &info, H5P_DEFAULT) < 0)
        throw_file_error(path, prefix, "cannot be found");
      demand(path, info.type == H5L_TYPE_HARD,
             "{} is a link (links are not followed: the data must lie in the file itself)",
             where(prefix));
    }
    return true;
  }

  [[nodiscard]] Hdf5Handle open(const std::string& name) const {
    demand(path, reachable(name), "{} is missing; was the file written by another program?",
           where(name));
    Hdf5Handle dataset(H5Dopen2(file, name.c_str(), H5P_DEFAULT), &H5Dclose);
    if (!dataset.valid()) throw_file_error(path, name, "cannot be opened");
    const Hdf5Handle layout(H5Dget_create_plist(dataset), &H5Pclose);
    demand(path, H5Pget_external_count(layout) == 0 && H5Pget_layout(layout) != H5D_VIRTUAL,
           "{} keeps its values in other files (only values in the file itself are read)",
           where(name));
    return dataset;
  }

  [[nodiscard]] Shape shape(const std::string& name, hid_t dataset) const {
    const Hdf5Handle space(H5Dget_space(dataset), &H5Sclose);
    const int rank = H5Sget_simple_extent_ndims(space);
    if (rank < 0) throw_file_error(path, name, "has no shape");
    std::vector<hsize_t> extent(rank);
    H5Sget_simple_extent_dims(space, extent.data(), nullptr);
    const Hdf5Handle type(H5Dget_type(dataset), &H5Tclose);
    double bytes = static_cast<double>(H5Tget_size(type));
    for (hsize_t n : extent) bytes *= static_cast<double>(n);
    if (!(bytes <= kMaxCompression * static_cast<double>(file_size)))
      throw_file_error(path, name,
                       fmt::format("claims {:.3g} bytes, more than a file of {} bytes can hold; "
                                   "the file is damaged",
                                   bytes, file_size));
    if (bytes > 0.0) check_chunks(name, dataset, extent);
    return {extent.begin(), extent.end()};
  }

  /// HDF5 reads chunks that were never written as zeros.
  void check_chunks(const std::string& name, hid_t dataset,
                    const std::vector<hsize_t>& extent) const {
    if (complete.count(name) > 0) return;
    const Hdf5Handle layout(H5Dget_create_plist(dataset), &H5Pclose);
    if (H5Pget_layout(layout) == H5D_CHUNKED) {
      std::vector<hsize_t> chunk(extent.size());
      H5Pget_chunk(layout, static_cast<int>(chunk.size()), chunk.data());
      hsize_t expected = 1, found = 0;
      for (std::size_t d = 0; d < extent.size(); ++d)
        expected *= (extent[d] + chunk[d] - 1) / std::max<hsize_t>(chunk[d], 1);
      const Hdf5Handle space(H5Dget_space(dataset), &H5Sclose);
      if (H5Dget_num_chunks(dataset, space, &found) < 0 || found != expected)
        throw_file_error(path, name,
                         fmt::format("has {} of {} pieces (the disk was full when it was written); "
                                     "make the file again",
                                     found, expected));
    }
    complete.insert(name);
  }

  /// Reads `space` of the dataset (H5S_ALL for all) with the conversion that `type` asks for.
  void read(const std::string& name, hid_t dataset, hid_t memory, hid_t space, Scalar type,
            std::size_t count, void* data, Nan nan) const {
    const Hdf5Handle stored(H5Dget_type(dataset), &H5Tclose);
    const H5T_class_t group = H5Tget_class(stored);
    const bool real = type == Scalar::f64;
    demand(path, group == H5T_INTEGER || (real && group == H5T_FLOAT), "{} does not hold {}",
           where(name), real ? "numbers" : "whole numbers");
    if (count == 0) return;
    std::vector<std::int64_t> wide(real ? 0 : count);
    if (H5Dread(dataset, memory_type(real ? Scalar::f64 : Scalar::i64), memory, space, H5P_DEFAULT,
                real ? data : wide.data()) < 0)
      throw_file_error(path, name, "cannot be read; the file is damaged, copy or make it again");
    switch (type) {
      case Scalar::f64:
        check_finite(path, name, static_cast<double*>(data), count, nan);
        break;
      case Scalar::i64:
        narrow<std::int64_t>(where(name), wide, data);
        break;
      case Scalar::i32:
        narrow<std::int32_t>(where(name), wide, data);
        break;
      case Scalar::u8:
        narrow<std::uint8_t>(where(name), wide, data);
        break;
    }
  }
};

FieldReader::FieldReader(const std::filesystem::path& path, std::string_view kind,
                         int newest_format, int oldest_format)
    : impl_(std::make_unique<Impl>()) {
  start_hdf5();
  impl_->path = path;
  impl_->file_size = check_signature(path);
  impl_->file = open_file(path);
  const std::string stored = root_text(path, impl_->file, "kind");
  demand(path, stored == kind, "'{}' {}, but '{}' is needed here; name another file", path.string(),
         stored.empty() ? "was not written by flowslide (it has no attribute 'kind')"
                        : fmt::format("is of the kind '{}'", stored),
         kind);
  const std::int64_t format = root_integer(path, impl_->file, "format_version");
  demand(path, format >= oldest_format && format <= newest_format,
         "'{}' has the format version {} of {} (this program reads {} to {}, the file comes from "
         "{}); use the program that wrote it or make the file again",
         path.string(), format, kind, oldest_format, newest_format,
         root_text(path, impl_->file, "program"));
}

FieldReader::~FieldReader() = default;
FieldReader::FieldReader(FieldReader&&) noexcept = default;
FieldReader& FieldReader::operator=(FieldReader&&) noexcept = default;

const std::filesystem::path& FieldReader::path() const { return impl_->path; }

bool FieldReader::has(const std::string& name) const { return impl_->reachable(name); }

std::size_t FieldReader::rows(const std::string& name) const {
  const Shape shape = impl_->shape(name, impl_->open(name));
  demand(impl_->path, !shape.empty(), "{} is a single value (a list is expected)",
         impl_->where(name));
  return shape[0];
}

std::vector<std::string> FieldReader::names(const std::string& group) const {
  demand(impl_->path, impl_->reachable(group), "'{}': group '{}' is missing", impl_->path.string(),
         group);
  const Hdf5Handle handle(H5Gopen2(impl_->file, group.c_str(), H5P_DEFAULT), &H5Gclose);
  std::vector<std::string> names;
  const auto add = [](hid_t, const char* name, const H5L_info_t*, void* out) -> herr_t {
    static_cast<std::vector<std::string>*>(out)->emplace_back(name);
    return 0;
  };
  if (!handle.valid() || H5Literate(handle, H5_INDEX_NAME, H5_ITER_INC, nullptr, add, &names) < 0)
    throw_file_error(impl_->path, group, "cannot be listed");
  std::sort(names.begin(), names.end());
  return names;
}

void FieldReader::check_shape(const std::string& name, const Shape& expected) const {
  const Shape found = impl_->shape(name, impl_->open(name));
  demand(impl_->path, found == expected, "{} has the shape {} (expected {})", impl_->where(name),
         shape_text(found), shape_text(expected));
}

void FieldReader::read_array(const std::string& name, Scalar type, const Shape& shape, void* data,
                             Nan nan) const {
  std::size_t count = 1;
  for (std::size_t n : shape) count *= n;
  impl_->read(name, impl_->open(name), H5S_ALL, H5S_ALL, type, count, data, nan);
}

void FieldReader::read_series_row(const std::string& name, std::size_t index, Scalar type,
                                  const Shape& shape, void* data, Nan nan) const {
  const Hdf5Handle dataset = impl_->open(name);
  std::vector<hsize_t> extent(shape.begin(), shape.end());
  extent.insert(extent.begin(), 1);
  std::vector<hsize_t> start(extent.size(), 0);
  start[0] = index;
  const Hdf5Handle space(H5Dget_space(dataset), &H5Sclose);
  const Hdf5Handle memory(H5Screate_simple(static_cast<int>(extent.size()), extent.data(), nullptr),
                          &H5Sclose);
  demand(impl_->path, index < rows(name), "{} has no row {} (it has {})", impl_->where(name), index,
         rows(name));
  if (H5Sselect_hyperslab(space, H5S_SELECT_SET, start.data(), nullptr, extent.data(), nullptr) < 0)
    throw_file_error(impl_->path, name, "cannot be read");
  std::size_t count = 1;
  for (std::size_t n : shape) count *= n;
  impl_->read(name, dataset, memory, space, type, count, data, nan);
}

std::vector<std::vector<double>> FieldReader::read_table(const std::string& name, std::size_t rows,
                                                         std::size_t columns, Nan nan) const {
  check_shape(name, {rows, columns});
  std::vector<double> flat(rows * columns);
  read_array(name, Scalar::f64, {rows, columns}, flat.data(), nan);
  std::vector<std::vector<double>> table;
  for (std::size_t i = 0; i < rows; ++i)
    table.emplace_back(flat.begin() + static_cast<std::ptrdiff_t>(i * columns),
                       flat.begin() + static_cast<std::ptrdiff_t>((i + 1) * columns));
  return table;
}

std::vector<std::string> FieldReader::read_texts(const std::string& name, std::size_t rows) const {
  const std::size_t count = rows == kAnyRows ? this->rows(name) : rows;
  check_shape(name, {count});
  const Hdf5Handle dataset = impl_->open(name);
  const Hdf5Handle type(H5Dget_type(dataset), &H5Tclose);
  demand(impl_->path, H5Tget_class(type) == H5T_STRING && H5Tis_variable_str(type) == 0,
         "{} does not hold text of fixed length", impl_->where(name));
  const std::size_t length = H5Tget_size(type);
  std::string bytes(count * length, '\0');
  if (count > 0 && H5Dread(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, bytes.data()) < 0)
    throw_file_error(impl_->path, name,
                     "cannot be read; the file is damaged, copy or make it again");
  std::vector<std::string> texts;
  for (std::size_t i = 0; i < count; ++i)
    texts.push_back(trimmed(bytes.substr(i * length, length)));
  return texts;
}

std::string stored_kind(const std::filesystem::path& path) {
  start_hdf5();
  check_signature(path);
  const Hdf5Handle file = open_file(path);
  return root_text(path, file, "kind");
}

}  // namespace flowslide
