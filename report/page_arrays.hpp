#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

/// Numbers of a page, packed for a browser: quantised to 8 or 16 bits, predicted from their
/// neighbours, deflated, in base64. page/arrays.js is the inverse.
namespace flowslide {

enum class Bits { eight = 8, sixteen = 16 };

class PageArrays {
 public:
  /// Rows of equal length, such as one row per instant and one column per point. A value becomes
  /// the nearest of `lowest + k step`, at most 254 or 65534 steps; NaN stays NaN. What is stored of
  /// it is the difference from last row's value plus what the neighbour before has moved by.
  /// Throws NumericsError for infinite values.
  void add(std::string_view name, std::span<const double> values, std::size_t rows = 1,
           Bits bits = Bits::sixteen);
  /// As above, with steps not smaller than `step`: digits that mean nothing do not compress.
  void add(std::string_view name, std::span<const double> values, std::size_t rows, Bits bits,
           double step);

  /// JSON list of {name, bits, rows, columns, lowest, step}, in the order of the bytes.
  [[nodiscard]] std::string index() const;
  /// All arrays, packed.
  [[nodiscard]] std::string text() const;

 private:
  struct Entry {
    std::string name;
    Bits bits;
    std::size_t rows, columns;
    double lowest, step;
  };
  std::vector<Entry> entries_;
  std::string bytes_;
};

/// Deflated (zlib's format), in base64. Throws FileError without memory for it.
std::string packed(std::string_view bytes);

/// RFC 4648, with padding.
std::string base64(std::string_view bytes);

}  // namespace flowslide
