#pragma once
#include <span>
#include <string_view>

namespace flowslide::study {

/// A warning by words that it has, and what it means for the runout of its row.
struct Consequence {
  std::string_view words, meaning;
};
std::span<const Consequence> known_consequences();

/// One sentence; empty for a warning whose meaning the program does not know.
std::string_view consequence_of(std::string_view warning);

}  // namespace flowslide::study
