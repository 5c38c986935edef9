#pragma once
#include "core/check.hpp"
#include "core/voigt.hpp"

#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

/// Named arrays in HDF5 files: the layer under every file that one stage hands to the next.
///
/// Each file has the root attributes `kind`, `format_version`, `program` and `conventions`, each
/// dataset the attributes `unit` and `convention`. Readers find datasets by name, convert number
/// types (never by truncation) and check shapes. Equal content gives equal bytes: no time stamps,
/// one fixed format version of HDF5. Metadata and chunks carry checksums, so damage is noticed.
/// Nothing outside the file is followed: no soft or external links, virtual or external data.
/// HDF5 is used from one thread at a time.
namespace flowslide {

enum class Nan {
  refused,
  allowed,  ///< NaN means unset; infinite values are refused all the same
};

/// What a dataset says about itself.
struct FieldLabel {
  std::string_view unit;  ///< "m", "Pa"; "" for a count, an index or a tag, "-" for a ratio
  std::string_view convention = "";  ///< signs and components in words
  Nan nan = Nan::refused;
};

enum class Scalar { f64, i64, i32, u8 };

/// Scalar type and components of an array element; width 0 stands for a plain number.
template <class T>
struct ElementType;
template <>
struct ElementType<double> : std::integral_constant<Scalar, Scalar::f64> {
  static constexpr std::size_t width = 0;
};
template <>
struct ElementType<std::int64_t> : std::integral_constant<Scalar, Scalar::i64> {
  static constexpr std::size_t width = 0;
};
template <>
struct ElementType<std::int32_t> : std::integral_constant<Scalar, Scalar::i32> {
  static constexpr std::size_t width = 0;
};
template <>
struct ElementType<std::uint8_t> : std::integral_constant<Scalar, Scalar::u8> {
  static constexpr std::size_t width = 0;
};
template <class T, std::size_t N>
struct ElementType<std::array<T, N>> : ElementType<T> {
  static constexpr std::size_t width = N;
};
template <int Dim>
struct ElementType<Stress<Dim>> : ElementType<double> {
  static constexpr std::size_t width = kVoigt<Dim>;
};
template <int Dim>
struct ElementType<StrainIncrement<Dim>> : ElementType<double> {
  static constexpr std::size_t width = kVoigt<Dim>;
};

using Shape = std::vector<std::size_t>;

template <class T>
Shape shape_of(std::size_t size) {
  if constexpr (ElementType<T>::width == 0)
    return {size};
  else
    return {size, ElementType<T>::width};
}

/// Writes under a temporary name, which becomes `path` in finish(), when the data are on the disk,
/// have been read again and are what was given; a writer that is destroyed before leaves neither.
/// Throws FileError, and InputError for values that the label does not allow.
class FieldWriter {
 public:
  FieldWriter(const std::filesystem::path& path, std::string_view kind, int format_version);
  ~FieldWriter();
  FieldWriter(const FieldWriter&) = delete;
  FieldWriter& operator=(const FieldWriter&) = delete;

  /// `name` may contain groups: "mesh/nodes".
  template <class T>
  void write(const std::string& name, const std::vector<T>& values, const FieldLabel& label) {
    write_array(name, ElementType<T>::value, shape_of<T>(values.size()), values.data(), label);
  }
  /// Rows of equal length `columns`; shape (rows, columns).
  void write_table(const std::string& name, const std::vector<std::vector<double>>& rows,
                   std::size_t columns, const FieldLabel& label);
  void write_texts(const std::string& name, const std::vector<std::string>& texts,
                   std::string_view convention = "");
  /// Adds one row to a series of shape (rows, size[, components]); one row is one chunk. The first
  /// call creates the series, the later ones must have the same size.
  template <class T>
  void append(const std::string& name, const std::vector<T>& row, const FieldLabel& label) {
    append_row(name, ElementType<T>::value, shape_of<T>(row.size()), row.data(), label);
  }
  void finish();

 private:
  void write_array(const std::string& name, Scalar type, const Shape& shape, const void* data,
                   const FieldLabel& label);
  void append_row(const std::string& name, Scalar type, const Shape& shape, const void* data,
                  const FieldLabel& label);
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// As many rows as the file has.
inline constexpr std::size_t kAnyRows = static_cast<std::size_t>(-1);

/// Throws FileError where the file cannot be read or is damaged, InputError where it is of another
/// kind, too new or too old, or a dataset is missing, of another shape or type, or holds NaN
/// without leave.
class FieldReader {
 public:
  FieldReader(const std::filesystem::path& path, std::string_view kind, int newest_format,
              int oldest_format = 1);
  ~FieldReader();
  FieldReader(FieldReader&&) noexcept;
  FieldReader& operator=(FieldReader&&) noexcept;

  [[nodiscard]] const std::filesystem::path& path() const;
  [[nodiscard]] bool has(const std::string& name) const;
  /// Extent of the first dimension.
  [[nodiscard]] std::size_t rows(const std::string& name) const;
  /// Names of the datasets and groups directly inside a group, in alphabetical order.
  [[nodiscard]] std::vector<std::string> names(const std::string& group) const;

  template <class T>
  [[nodiscard]] std::vector<T> read(const std::string& name, std::size_t rows = kAnyRows,
                                    Nan nan = Nan::refused) const {
    if (rows == kAnyRows) rows = this->rows(name);
    std::vector<T> values;
    // The shape is compared before memory is taken: a damaged extent must not exhaust it.
    check_shape(name, shape_of<T>(rows));
    values.resize(rows);
    read_array(name, ElementType<T>::value, shape_of<T>(rows), values.data(), nan);
    return values;
  }
  template <class T>
  [[nodiscard]] T read_one(const std::string& name, Nan nan = Nan::refused) const {
    return read<T>(name, 1, nan)[0];
  }
  /// Row `index` of a series whose rows have `size` elements.
  template <class T>
  [[nodiscard]] std::vector<T> read_row(const std::string& name, std::size_t index,
                                        std::size_t size, Nan nan = Nan::refused) const {
    Shape shape = shape_of<T>(size);
    shape.insert(shape.begin(), rows(name));
    check_shape(name, shape);
    std::vector<T> values(size);
    read_series_row(name, index, ElementType<T>::value, shape_of<T>(size), values.data(), nan);
    return values;
  }
  [[nodiscard]] std::vector<std::vector<double>> read_table(const std::string& name,
                                                            std::size_t rows, std::size_t columns,
                                                            Nan nan = Nan::refused) const;
  [[nodiscard]] std::vector<std::string> read_texts(const std::string& name,
                                                    std::size_t rows = kAnyRows) const;

 private:
  void check_shape(const std::string& name, const Shape& expected) const;
  void read_array(const std::string& name, Scalar type, const Shape& shape, void* data,
                  Nan nan) const;
  void read_series_row(const std::string& name, std::size_t index, Scalar type, const Shape& shape,
                       void* data, Nan nan) const;
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Root attribute `kind` of an HDF5 file, empty if it has none (then it is not one of ours).
/// Throws FileError if the file is missing, damaged or not HDF5.
std::string stored_kind(const std::filesystem::path& path);

}  // namespace flowslide
