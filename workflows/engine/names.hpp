#pragma once
#include <string_view>

/// Names that come from files become paths: here is what each may be.
namespace flowslide {

/// Of a workflow or a stage: letters, digits, '-' and '_', which every file system and shell takes
/// as they are.
bool is_name(std::string_view text);

/// A path that stays inside the folder to which it is joined: not absolute, no part empty, "." or
/// "..", no control characters.
bool stays_inside(std::string_view path);

/// SHA-256 as written: 64 lower-case hexadecimal digits.
bool is_digest(std::string_view text);

}  // namespace flowslide
