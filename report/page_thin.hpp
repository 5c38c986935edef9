#pragma once
#include <cstddef>
#include <string>
#include <string_view>

namespace flowslide {

/// How many states the player of a page of a run has; 0 if the page is none of this program's.
std::size_t page_states(std::string_view html);

/// The page with at most so many states in its player, at least 2: the first, the last, and others
/// evenly among those that were chosen for it. All other numbers stay as they are, to the bit. A
/// page that is none of this program's comes back as it is. Throws InputError for one that is
/// damaged.
std::string thinned_page(const std::string& html, std::size_t states);

}  // namespace flowslide
