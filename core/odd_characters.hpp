#pragma once
#include <string>
#include <string_view>

namespace flowslide {

/// What looks like a number or a blank to people but is none: a decimal comma, a non-breaking or
/// thin space, a long minus sign, a byte-order mark inside a file, full-width digits. For readers
/// of text, to say why a token is no number: "has a decimal comma ... write '.'"; empty if nothing
/// of the kind is there.
std::string odd_characters(std::string_view token);

}  // namespace flowslide
