#pragma once
#include <optional>
#include <string>
#include <string_view>

/// What the numbers are that stages of this program find, for whoever does not know it.
namespace flowslide::study {

struct Meaning {
  std::string words;       ///< a name to read, without its unit
  std::string definition;  ///< half a sentence, no full stop
};

/// Of a column that a stage has found; nothing where its name says it.
std::optional<Meaning> meaning_of(std::string_view column);

}  // namespace flowslide::study
