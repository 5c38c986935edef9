#include "report/page_arrays.hpp"

#include "core/check.hpp"

#include <algorithm>
#include <cmath>
#include <zlib.h>

#include <nlohmann/json.hpp>

namespace flowslide {
namespace {

/// Small differences of either sign become small numbers.
template <class T>
T zigzag(T difference) {
  constexpr int top = 8 * sizeof(T) - 1;
  const T sign = difference >> top ? static_cast<T>(-1) : T{0};
  return static_cast<T>(static_cast<T>(difference << 1) ^ sign);
}

/// Low bytes of all numbers, then high bytes: each compresses better among its like.
template <class T>
void append_planes(std::string& out, const std::vector<T>& numbers) {
  for (std::size_t byte = 0; byte < sizeof(T); ++byte)
    for (const T number : numbers) out += static_cast<char>((number >> (8 * byte)) & 0xff);
}

template <class T>
void append(std::string& out, std::span<const double> values, std::size_t rows, double lowest,
            double step) {
  constexpr T unset = static_cast<T>(-1);
  const std::size_t columns = values.size() / rows;
  std::vector<T> before(columns, T{0}), row(columns), coded;
  coded.reserve(values.size());
  for (std::size_t r = 0; r < rows; ++r) {
    T left = 0, left_before = 0;
    for (std::size_t c = 0; c < columns; ++c) {
      const double value = values[r * columns + c];
      row[c] = std::isnan(value) ? unset : static_cast<T>(std::lround((value - lowest) / step));
      const T predicted = static_cast<T>(before[c] + left - left_before);
      coded.push_back(zigzag(static_cast<T>(row[c] - predicted)));
      left = row[c];
      left_before = before[c];
    }
    std::swap(before, row);
  }
  append_planes(out, coded);
}

}  // namespace

void PageArrays::add(std::string_view name, std::span<const double> values, std::size_t rows,
                     Bits bits) {
  add(name, values, rows, bits, 0.0);
}

void PageArrays::add(std::string_view name, std::span<const double> values, std::size_t rows,
                     Bits bits, double step) {
  FLOWSLIDE_EXPECT(rows > 0 && values.size() % rows == 0);
  double low = kUnset, high = kUnset;
  for (const double value : values) {
    if (std::isinf(value))
      throw NumericsError(fmt::format(
          "{}: a value is infinite (the page of the report cannot show it) look for it in the "
          "result of the stage before",
          name));
    if (!(low <= value) && is_set(value)) low = value;
    if (!(high >= value) && is_set(value)) high = value;
  }
  if (!is_set(low)) low = high = 0.0;
  const double levels = bits == Bits::eight ? 254.0 : 65534.0;
  step = std::max(step, (high - low) / levels);
  if (!(step > 0.0)) step = 1.0;
  entries_.push_back({std::string(name), bits, rows, values.size() / rows, low, step});
  if (bits == Bits::eight)
    append<std::uint8_t>(bytes_, values, rows, low, step);
  else
    append<std::uint16_t>(bytes_, values, rows, low, step);
}

std::string PageArrays::index() const {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const Entry& e : entries_)
    list.push_back({{"name", e.name},
                    {"bits", static_cast<int>(e.bits)},
                    {"rows", e.rows},
                    {"columns", e.columns},
                    {"lowest", e.lowest},
                    {"step", e.step}});
  return list.dump();
}

std::string PageArrays::text() const { return packed(bytes_); }

std::string packed(std::string_view bytes) {
  uLongf size = compressBound(static_cast<uLong>(bytes.size()));
  std::string deflated(size, '\0');
  const int status =
      compress2(reinterpret_cast<Bytef*>(deflated.data()), &size,
                reinterpret_cast<const Bytef*>(bytes.data()), static_cast<uLong>(bytes.size()), 6);
  if (status != Z_OK)
    throw FileError(
        "the numbers of the page cannot be compressed (memory does not suffice) close "
        "other programs");
  deflated.resize(size);
  return base64(deflated);
}

std::string base64(std::string_view bytes) {
  constexpr std::string_view digits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  out.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t word = 0;
    const std::size_t n = std::min<std::size_t>(3, bytes.size() - i);
    for (std::size_t k = 0; k < 3; ++k)
      word = (word << 8) | (k < n ? static_cast<unsigned char>(bytes[i + k]) : 0u);
    for (std::size_t k = 0; k < 4; ++k) out += k <= n ? digits[(word >> (18 - 6 * k)) & 63] : '=';
  }
  return out;
}

}  // namespace flowslide
