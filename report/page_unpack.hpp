#pragma once
#include "report/page.hpp"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

/// Reading what the page of a run holds for its player.
namespace flowslide {

using PageJson = nlohmann::ordered_json;

/// The element with the JSON of the run; none if the page is none of this program's.
std::optional<PageElement> find_run(std::string_view html);

/// Throws InputError: the page is damaged, and why.
[[noreturn]] void damaged_page(std::string_view what);

/// An array as it lies among the bytes of the page.
struct StoredArray {
  std::size_t rows = 0, columns = 0, width = 1;  ///< width: bytes of a number, 1 or 2
  [[nodiscard]] std::size_t bytes() const { return rows * columns * width; }
  [[nodiscard]] std::size_t size() const { return rows * columns; }
};
/// Throws InputError and Json::exception for what is none.
StoredArray stored_array(const PageJson& entry);

/// The bytes of all arrays of a page, one after the other as `run` lists them. Throws InputError if
/// they are not as many as it says, Json::exception if it does not say so.
std::string page_bytes(std::string_view html, const PageJson& run);

}  // namespace flowslide
