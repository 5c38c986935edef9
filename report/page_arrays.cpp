#include "report/page_arrays.hpp"

#include "core/check.hpp"
#include "report/page_levels.hpp"

#include <algorithm>
#include <cmath>
#include <zlib.h>

#include <nlohmann/json.hpp>

namespace flowslide {
namespace {

std::vector<std::uint32_t> levels_of(std::span<const double> values, double lowest, double step,
                                     std::uint32_t unset) {
  std::vector<std::uint32_t> levels;
  levels.reserve(values.size());
  for (const double value : values)
    levels.push_back(std::isnan(value)
                         ? unset
                         : static_cast<std::uint32_t>(std::lround((value - lowest) / step)));
  return levels;
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
  const std::size_t columns = values.size() / rows;
  entries_.push_back({std::string(name), bits, rows, columns, low, step});
  const bool one_byte = bits == Bits::eight;
  bytes_ += coded_levels(levels_of(values, low, step, one_byte ? 0xffu : 0xffffu), columns,
                         one_byte ? 1 : 2);
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
