#pragma once
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace flowslide {

/// Nearest of `known` to `word` by edit distance, if near enough to be a typing error.
std::optional<std::string> nearest(std::string_view word, std::span<const std::string> known);

}  // namespace flowslide
