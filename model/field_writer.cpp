#include "core/files.hpp"
#include "model/chunk_filters.hpp"
#include "model/field_store.hpp"
#include "model/hdf5_handle.hpp"
#include "model/written_fields.hpp"

#include <algorithm>
#include <bit>
#include <map>

namespace flowslide {
namespace {

constexpr std::string_view kConventions =
    "SI units; stress tension positive; pore pressure compression positive; total = effective - "
    "pore pressure on the normal components; components xx yy zz xy (plane strain) or xx yy zz xy "
    "yz zx; engineering shear strain; y points up; NaN means unset";

/// Rows of a chunk are bounded because HDF5 limits a chunk to 4 GiB.
constexpr std::size_t kChunkRows = 1u << 20;

bool set_text(hid_t object, const char* name, std::string_view text) {
  const Hdf5Handle type = text_type(text.size());
  const Hdf5Handle space(H5Screate(H5S_SCALAR), &H5Sclose);
  const Hdf5Handle attribute(H5Acreate2(object, name, type, space, H5P_DEFAULT, H5P_DEFAULT),
                             &H5Aclose);
  const std::string bytes = text.empty() ? std::string(1, '\0') : std::string(text);
  return attribute.valid() && H5Awrite(attribute, type, bytes.data()) >= 0;
}

bool set_integer(hid_t object, const char* name, std::int64_t value) {
  const Hdf5Handle space(H5Screate(H5S_SCALAR), &H5Sclose);
  const Hdf5Handle attribute(
      H5Acreate2(object, name, H5T_STD_I64LE, space, H5P_DEFAULT, H5P_DEFAULT), &H5Aclose);
  return attribute.valid() && H5Awrite(attribute, H5T_NATIVE_INT64, &value) >= 0;
}

/// Creates the groups in front of the last part of a name, without the times that HDF5 would give
/// to those it creates by itself.
bool create_groups(hid_t file, const std::string& name) {
  const Hdf5Handle creation(H5Pcreate(H5P_GROUP_CREATE), &H5Pclose);
  expect_hdf5(H5Pset_obj_track_times(creation, false) >= 0);
  for (auto at = name.find('/'); at != std::string::npos; at = name.find('/', at + 1)) {
    const std::string group = name.substr(0, at);
    if (H5Lexists(file, group.c_str(), H5P_DEFAULT) > 0) continue;
    const Hdf5Handle made(H5Gcreate2(file, group.c_str(), H5P_DEFAULT, creation, H5P_DEFAULT),
                          &H5Gclose);
    if (!made.valid()) return false;
  }
  return true;
}

}  // namespace

struct FieldWriter::Impl {
  std::filesystem::path path, partial;
  Hdf5Handle file;
  WrittenFields written;
  struct Series {
    Hdf5Handle dataset;
    Shape row;
    hsize_t rows = 0;
  };
  std::map<std::string, Series> series;
  ChunkFilters filters;
  bool finished = false;

  ~Impl() {
    if (finished) return;
    series.clear();
    file.release();
    std::error_code ignored;
    std::filesystem::remove(partial, ignored);
  }

  /// Creates a dataset of the given extent; `chunk` empty stands for one contiguous block.
  Hdf5Handle create(const std::string& name, hid_t type, const std::vector<hsize_t>& extent,
                    const std::vector<hsize_t>& limit, const std::vector<hsize_t>& chunk,
                    const FieldLabel& label) {
    const Hdf5Handle space(
        H5Screate_simple(static_cast<int>(extent.size()), extent.data(), limit.data()), &H5Sclose);
    if (!create_groups(file, name)) throw_file_error(path, name, "cannot be created");
    const Hdf5Handle layout(H5Pcreate(H5P_DATASET_CREATE), &H5Pclose);
    expect_hdf5(H5Pset_obj_track_times(layout, false) >= 0);
    if (!chunk.empty())
      expect_hdf5(H5Pset_chunk(layout, static_cast<int>(chunk.size()), chunk.data()) >= 0 &&
                  H5Pset_shuffle(layout) >= 0 && H5Pset_deflate(layout, 1) >= 0 &&
                  H5Pset_fletcher32(layout) >= 0);  // as ChunkFilters leaves them
    Hdf5Handle dataset(
        H5Dcreate2(file, name.c_str(), type, space, H5P_DEFAULT, layout, H5P_DEFAULT), &H5Dclose);
    if (!dataset.valid() || !set_text(dataset, "unit", label.unit) ||
        !set_text(dataset, "convention", label.convention))
      throw_file_error(path, name, "cannot be created");
    return dataset;
  }

  /// Writes `rows` rows of `row` values in chunks of at most `chunk_rows`; the first chunk is at
  /// `at`, whose component `along` counts rows.
  bool write_chunks(hid_t dataset, std::size_t value_bytes, hsize_t rows, hsize_t chunk_rows,
                    std::size_t row, std::vector<hsize_t> at, std::size_t along, const void* data) {
    static_assert(std::endian::native == std::endian::little);  // as disk_type()
    for (hsize_t first = 0; first < rows; first += chunk_rows) {
      const auto packed =
          filters.apply(static_cast<const std::uint8_t*>(data) + first * row * value_bytes,
                        std::min(chunk_rows, rows - first) * row, chunk_rows * row, value_bytes);
      at[along] = first;
      if (H5Dwrite_chunk(dataset, H5P_DEFAULT, 0, at.data(), packed.size(), packed.data()) < 0)
        return false;
    }
    return true;
  }

  /// HDF5 keeps chunks in memory until a dataset is closed.
  void close(const std::string& name, Hdf5Handle& dataset) const {
    if (dataset.release() < 0) throw_file_error(path, name, "cannot be written");
  }
};

FieldWriter::FieldWriter(const std::filesystem::path& path, std::string_view kind,
                         int format_version)
    : impl_(std::make_unique<Impl>()) {
  start_hdf5();
  impl_->path = path;
  impl_->partial = temporary_name(path);
  const Hdf5Handle creation(H5Pcreate(H5P_FILE_CREATE), &H5Pclose);
  expect_hdf5(H5Pset_obj_track_times(creation, false) >= 0);
  const Hdf5Handle access = file_access();
  impl_->file =
      Hdf5Handle(H5Fcreate(impl_->partial.c_str(), H5F_ACC_EXCL, creation, access), &H5Fclose);
  if (!impl_->file.valid()) throw_file_error(impl_->path, "", "cannot be created");
  if (!set_text(impl_->file, "kind", kind) ||
      !set_integer(impl_->file, "format_version", format_version) ||
      !set_text(impl_->file, "program", "flowslide " FLOWSLIDE_VERSION) ||
      !set_text(impl_->file, "conventions", kConventions))
    throw_file_error(impl_->path, "", "cannot be written");
}

FieldWriter::~FieldWriter() = default;

void FieldWriter::write_array(const std::string& name, Scalar type, const Shape& shape,
                              const void* data, const FieldLabel& label) {
  const std::vector<hsize_t> extent(shape.begin(), shape.end());
  hsize_t count = 1;
  for (hsize_t n : extent) count *= n;
  if (type == Scalar::f64)
    check_finite(impl_->path, name, static_cast<const double*>(data), count, label.nan);
  std::vector<hsize_t> chunk;
  if (count > 0) {
    chunk = extent;
    chunk[0] = std::min<hsize_t>(chunk[0], kChunkRows);
  }
  Hdf5Handle dataset = impl_->create(name, disk_type(type), extent, extent, chunk, label);
  if (count > 0 &&
      !impl_->write_chunks(dataset, H5Tget_size(disk_type(type)), shape[0], chunk[0],
                           count / shape[0], std::vector<hsize_t>(shape.size(), 0), 0, data))
    throw_file_error(impl_->path, name, "cannot be written");
  impl_->close(name, dataset);
  impl_->written.add(name, type, 0, shape[0], {shape.begin() + 1, shape.end()}, data);
}

void FieldWriter::write_table(const std::string& name, const std::vector<std::vector<double>>& rows,
                              std::size_t columns, const FieldLabel& label) {
  std::vector<double> flat;
  for (const std::vector<double>& row : rows) {
    validate(row.size() == columns, "'{}': dataset '{}': a row has {} values (expected {})",
             impl_->path.string(), name, row.size(), columns);
    flat.insert(flat.end(), row.begin(), row.end());
  }
  write_array(name, Scalar::f64, {rows.size(), columns}, flat.data(), label);
}

void FieldWriter::write_texts(const std::string& name, const std::vector<std::string>& texts,
                              std::string_view convention) {
  std::size_t length = 1;
  for (const std::string& text : texts) length = std::max(length, text.size());
  std::string bytes(texts.size() * length, '\0');
  for (std::size_t i = 0; i < texts.size(); ++i) texts[i].copy(&bytes[i * length], length);
  const std::vector<hsize_t> extent{texts.size()};
  const Hdf5Handle type = text_type(length);
  Hdf5Handle dataset =
      impl_->create(name, type, extent, extent, texts.empty() ? std::vector<hsize_t>{} : extent,
                    {.unit = "", .convention = convention});
  if (!texts.empty() &&
      !impl_->write_chunks(dataset, length, texts.size(), texts.size(), 1, {0}, 0, bytes.data()))
    throw_file_error(impl_->path, name, "cannot be written");
  impl_->close(name, dataset);
  impl_->written.add(name, Scalar::u8, length, texts.size(), {}, bytes.data());
}

void FieldWriter::append_row(const std::string& name, Scalar type, const Shape& shape,
                             const void* data, const FieldLabel& label) {
  hsize_t count = 1;
  for (std::size_t n : shape) count *= n;
  validate(count > 0, "'{}': dataset '{}': a row of a series is empty", impl_->path.string(), name);
  if (type == Scalar::f64)
    check_finite(impl_->path, name, static_cast<const double*>(data), count, label.nan);

  std::vector<hsize_t> extent(shape.begin(), shape.end());
  extent.insert(extent.begin(), 1);
  Impl::Series& series = impl_->series[name];
  if (!series.dataset.valid()) {
    std::vector<hsize_t> start = extent, limit = extent, chunk = extent;
    start[0] = 0;
    limit[0] = H5S_UNLIMITED;
    chunk[1] = std::min<hsize_t>(chunk[1], kChunkRows);
    series.dataset = impl_->create(name, disk_type(type), start, limit, chunk, label);
    series.row = shape;
  }
  validate(series.row == shape, "'{}': dataset '{}': a row has the shape {}, those before had {}",
           impl_->path.string(), name, shape_text(shape), shape_text(series.row));

  std::vector<hsize_t> whole = extent, start(extent.size(), 0);
  start[0] = series.rows;
  whole[0] = series.rows + 1;
  const bool done = H5Dset_extent(series.dataset, whole.data()) >= 0 &&
                    impl_->write_chunks(series.dataset, H5Tget_size(disk_type(type)), shape[0],
                                        std::min<hsize_t>(shape[0], kChunkRows), count / shape[0],
                                        start, 1, data);
  if (!done) throw_file_error(impl_->path, name, "cannot be written");
  ++series.rows;
  impl_->written.add(name, type, 0, 1, shape, data);
}

void FieldWriter::finish() {
  for (auto& [name, series] : impl_->series) impl_->close(name, series.dataset);
  if (H5Fflush(impl_->file, H5F_SCOPE_LOCAL) < 0 || impl_->file.release() < 0)
    throw_file_error(impl_->path, "", "cannot be completed; is the disk full?");
  sync_path(impl_->partial);
  impl_->written.compare(impl_->partial, impl_->path);
  rename_durably(impl_->partial, impl_->path);
  impl_->finished = true;
}

}  // namespace flowslide
