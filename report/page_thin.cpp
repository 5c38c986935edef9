#include "report/page_thin.hpp"

#include "core/check.hpp"
#include "report/page.hpp"
#include "report/page_arrays.hpp"
#include "report/page_levels.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <vector>
#include <zlib.h>

#include <nlohmann/json.hpp>

namespace flowslide {
namespace {

using ThinJson = nlohmann::ordered_json;

constexpr std::size_t kLargestPage = 1u << 28;  ///< bytes of all that is unpacked

/// Of one row per state.
constexpr std::array kOfStates{"points.x", "points.y", "points.speed", "points.strength"};

std::optional<PageElement> find_run(std::string_view html) {
  return find_element(html, kPageRun, "</script>");
}

[[noreturn]] void damaged(std::string_view what) {
  throw InputError(fmt::format(
      "a page of a run is damaged: {} (its player would show another flow). Make the report again.",
      what));
}

std::size_t count_in(const ThinJson& json, const char* name) {
  const ThinJson& count = json.at(name);
  if (!count.is_number_unsigned()) damaged(fmt::format("'{}' is no whole number", name));
  return count.get<std::size_t>();
}

std::string unpacked_bytes(std::string_view text, std::size_t size) {
  std::string deflated, bytes(size, '\0');
  deflated.reserve(text.size() / 4 * 3);
  std::uint32_t word = 0;
  int bits = 0;
  for (const char c : text) {
    if (c == '=') break;
    const int digit = c >= 'A' && c <= 'Z'   ? c - 'A'
                      : c >= 'a' && c <= 'z' ? c - 'a' + 26
                      : c >= '0' && c <= '9' ? c - '0' + 52
                      : c == '+'             ? 62
                      : c == '/'             ? 63
                                             : -1;
    if (digit < 0) damaged("its numbers are no base64");
    word = (word << 6) | static_cast<std::uint32_t>(digit);
    bits += 6;
    if (bits < 8) continue;
    bits -= 8;
    deflated += static_cast<char>((word >> bits) & 0xff);
  }
  uLongf got = static_cast<uLongf>(size);
  if (uncompress(reinterpret_cast<Bytef*>(bytes.data()), &got,
                 reinterpret_cast<const Bytef*>(deflated.data()),
                 static_cast<uLong>(deflated.size())) != Z_OK ||
      got != size)
    damaged("its numbers are cut off");
  return bytes;
}

/// An array of the page.
struct Levels {
  std::size_t rows = 0, columns = 0, width = 1;  ///< width: bytes of a number
  [[nodiscard]] std::size_t bytes() const { return rows * columns * width; }
};

/// The rows that stay.
std::vector<std::size_t> evenly(std::size_t of, std::size_t most) {
  std::vector<std::size_t> chosen;
  for (std::size_t k = 0; k < most; ++k)
    chosen.push_back((2 * k * (of - 1) + most - 1) / (2 * (most - 1)));
  return chosen;
}

class Thinning {
 public:
  Thinning(ThinJson& run, std::string bytes, std::size_t states)
      : run_(run),
        bytes_(std::move(bytes)),
        chosen_(evenly(count_in(run.at("points"), "frames"), states)) {}

  std::string write() {
    std::string out;
    std::size_t at = 0;
    for (ThinJson& entry : run_["arrays"]) {
      Levels a = levels_of(entry);
      const std::string_view bytes = std::string_view(bytes_).substr(at, a.bytes());
      at += a.bytes();
      out += kept(entry, a, bytes);
    }
    run_["points"]["frames"] = chosen_.size();
    return out;
  }

  static Levels levels_of(const ThinJson& entry) {
    return {count_in(entry, "rows"), count_in(entry, "columns"), count_in(entry, "bits") / 8};
  }

 private:
  std::string kept(ThinJson& entry, Levels a, std::string_view bytes) const {
    const std::string name = entry.at("name");
    const bool times = name == "points.t";
    if (!times && std::find(kOfStates.begin(), kOfStates.end(), name) == kOfStates.end())
      return std::string(bytes);
    const std::vector<std::uint32_t> all = decoded_levels(bytes, a.columns, a.width);
    std::vector<std::uint32_t> some;
    for (const std::size_t k : chosen_)
      if (times)
        some.push_back(all.at(k));
      else
        for (std::size_t c = 0; c < a.columns; ++c) some.push_back(all.at(k * a.columns + c));
    (times ? a.columns : a.rows) = chosen_.size();
    entry["rows"] = a.rows;
    entry["columns"] = a.columns;
    return coded_levels(some, a.columns, a.width);
  }

  ThinJson& run_;
  std::string bytes_;
  std::vector<std::size_t> chosen_;
};

}  // namespace

std::size_t page_states(std::string_view html) {
  const auto run = find_run(html);
  if (!run) return 0;
  const auto json = nlohmann::json::parse(html.substr(run->begin, run->size()), nullptr, false);
  if (!json.is_object() || !json.contains("points")) return 0;
  const auto& points = json["points"];
  if (!points.is_object() || !points.contains("frames")) return 0;
  return points["frames"].is_number_unsigned() ? points["frames"].get<std::size_t>() : 0;
}

std::string thinned_page(const std::string& html, std::size_t states) {
  const auto run = find_run(html);
  const auto arrays = find_element(html, kPageArrays, "</script>");
  if (!run || !arrays || page_states(html) <= std::max<std::size_t>(states, 2)) return html;
  try {
    ThinJson json = ThinJson::parse(html.substr(run->begin, run->size()));
    std::size_t size = 0;
    for (const ThinJson& entry : json.at("arrays")) {
      const Levels a = Thinning::levels_of(entry);
      if (a.rows > kLargestPage || a.columns > kLargestPage || a.width < 1 || a.width > 2)
        damaged("an array is too large");
      size += a.bytes();
      if (size > kLargestPage) damaged("its arrays are too large");
    }
    const std::string_view text = std::string_view(html).substr(arrays->begin, arrays->size());
    const std::string bytes =
        Thinning(json, unpacked_bytes(text, size), std::max<std::size_t>(states, 2)).write();
    std::string out = html;
    // the later one first: the place of the earlier stays
    out.replace(arrays->begin, arrays->size(), packed(bytes));
    out.replace(run->begin, run->size(), in_script(json.dump()));
    return out;
  } catch (const nlohmann::json::exception& e) {
    damaged(e.what());
  } catch (const std::out_of_range&) {
    damaged("its states are not as many as it says");
  }
}

}  // namespace flowslide
