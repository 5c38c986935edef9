#include "report/page_unpack.hpp"

#include "core/check.hpp"

#include <cstdint>
#include <zlib.h>

#include <nlohmann/json.hpp>

namespace flowslide {
namespace {

using PageJson = nlohmann::ordered_json;

constexpr std::size_t kLargestPage = 1u << 28;  ///< bytes of all that is unpacked

std::size_t count_in(const PageJson& json, const char* name) {
  const PageJson& count = json.at(name);
  if (!count.is_number_unsigned()) damaged_page(fmt::format("'{}' is no whole number", name));
  return count.get<std::size_t>();
}

StoredArray stored_array(const PageJson& entry) {
  const StoredArray a{.name = entry.at("name").get<std::string>(),
                      .rows = count_in(entry, "rows"),
                      .columns = count_in(entry, "columns"),
                      .width = count_in(entry, "bits") / 8,
                      .lowest = entry.at("lowest").get<double>(),
                      .step = entry.at("step").get<double>()};
  if (a.rows > kLargestPage || a.columns > kLargestPage || a.width < 1 || a.width > 2)
    damaged_page("an array is too large");
  return a;
}

int digit_of(char c) {
  return c >= 'A' && c <= 'Z'   ? c - 'A'
         : c >= 'a' && c <= 'z' ? c - 'a' + 26
         : c >= '0' && c <= '9' ? c - '0' + 52
         : c == '+'             ? 62
         : c == '/'             ? 63
                                : -1;
}

std::string unpacked_bytes(std::string_view text, std::size_t size) {
  std::string deflated, bytes(size, '\0');
  deflated.reserve(text.size() / 4 * 3);
  std::uint32_t word = 0;
  int bits = 0;
  for (const char c : text) {
    if (c == '=') break;
    const int digit = digit_of(c);
    if (digit < 0) damaged_page("its numbers are no base64");
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
    damaged_page("its numbers are cut off");
  return bytes;
}

}  // namespace

std::optional<PageElement> find_run(std::string_view html) {
  return find_element(html, kPageRun, "</script>");
}

void damaged_page(std::string_view what) {
  throw InputError(fmt::format(
      "a page of a run is damaged: {} (its player would show another flow). Make the report again.",
      what));
}

StoredArrays stored_arrays(std::string_view html) {
  const auto run = find_run(html);
  const auto arrays = find_element(html, kPageArrays, "</script>");
  if (!run || !arrays) damaged_page("it has no numbers");
  StoredArrays stored;
  std::size_t size = 0;
  try {
    const PageJson json = PageJson::parse(html.substr(run->begin, run->size()));
    for (const PageJson& entry : json.at("arrays")) {
      StoredArray& a = stored.list.emplace_back(stored_array(entry));
      a.at = size;
      size += a.bytes();
      if (size > kLargestPage) damaged_page("its arrays are too large");
    }
  } catch (const nlohmann::json::exception& e) {
    damaged_page(e.what());
  }
  stored.bytes = unpacked_bytes(html.substr(arrays->begin, arrays->size()), size);
  return stored;
}

}  // namespace flowslide
