#pragma once
#include <string>
#include <string_view>

namespace flowslide {

/// Text safe between tags and in quoted attributes of HTML, SVG and XML: &, <, > and quotes as
/// entities, control characters but the end of a line as spaces.
std::string xml_text(std::string_view text);

}  // namespace flowslide
