#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace flowslide {

/// Numbers that a stage of this type gives, or may give, by the names of their columns in the table
/// of a study; '*' stands for names that only a run knows, such as those of materials. Empty for a
/// type that is not known here. `settings` are the stage's, as canonical text.
std::vector<std::string> numbers_given(std::string_view type, std::string_view settings);

}  // namespace flowslide
