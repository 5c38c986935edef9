#pragma once
#include "report/page.hpp"

#include <string>
#include <string_view>
#include <vector>

/// Reading what the page of a run holds for its player.
namespace flowslide {

/// The element with the JSON of the run; none if the page is none of this program's.
std::optional<PageElement> find_run(std::string_view html);

/// Throws InputError: the page is damaged, and why.
[[noreturn]] void damaged_page(std::string_view what);

/// An array as it lies among the bytes of the page.
struct StoredArray {
  std::string name;
  std::size_t rows = 0, columns = 0, width = 1;  ///< width: bytes of a number, 1 or 2
  double lowest = 0.0, step = 1.0;               ///< of level k the value is lowest + k step
  std::size_t at = 0;                            ///< offset of its bytes
  [[nodiscard]] std::size_t bytes() const { return rows * columns * width; }
  [[nodiscard]] std::size_t size() const { return rows * columns; }
};

struct StoredArrays {
  std::vector<StoredArray> list;  ///< in the order of the JSON
  std::string bytes;              ///< of all, one after the other
  [[nodiscard]] std::string_view bytes_of(const StoredArray& a) const {
    return std::string_view(bytes).substr(a.at, a.bytes());
  }
};

/// All arrays of a page that has a run. Throws InputError if they are not what it says.
StoredArrays stored_arrays(std::string_view html);

}  // namespace flowslide
