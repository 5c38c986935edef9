#pragma once
#include "config/schema.hpp"

#include <optional>

namespace flowslide {

/// Part of a section, in reference coordinates [m]; a side left out is open.
struct SectionBox {
  std::optional<double> left, right, bottom, top;
};

template <>
struct Schema<SectionBox> {
  static constexpr std::string_view doc =
      "Part of the section that counts, without free-field columns; open where nothing is given.";
  static void describe(FieldVisitor& v, SectionBox& c) {
    v.quantity("left", c.left, Dim::length, {}, "smallest x");
    v.quantity("right", c.right, Dim::length, {}, "largest x");
    v.quantity("bottom", c.bottom, Dim::length, {}, "smallest y");
    v.quantity("top", c.top, Dim::length, {}, "largest y");
  }
};

}  // namespace flowslide
