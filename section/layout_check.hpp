#pragma once
#include "section/layout.hpp"

namespace flowslide {

/// No side of a block crosses one of another, and no block lies in another. Throws InputError.
void check_overlaps(const Layout& layout);

/// The segments with one block form one closed line around all. Throws InputError.
void check_boundary(const Layout& layout);

}  // namespace flowslide
