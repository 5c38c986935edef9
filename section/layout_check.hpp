#pragma once
#include "section/layout.hpp"

namespace flowslide {

/// No side of a block crosses one of another, and no block lies in another. Throws InputError.
void check_overlaps(const Layout& layout);

/// The segments with one block form one closed line around all. Throws InputError. Returns, as
/// sentences, where that line goes into the section and back at a sharp angle: there two blocks
/// that should touch part.
std::vector<std::string> check_boundary(const Layout& layout);

}  // namespace flowslide
