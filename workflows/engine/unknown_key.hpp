#pragma once
#include "config/yaml.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace flowslide {

/// "Did you mean 'x'?", or what there is.
std::string did_you_mean(std::string_view word, const std::vector<std::string>& known);

/// Throws InputError for a key that is not among the known ones.
void refuse_unknown_keys(const YamlNode& map, const std::vector<std::string>& known);

/// The same at the top of a workflow and in one of its stages; settings that were put beside the
/// `with` to which they belong are told their path.
void refuse_unknown_top_keys(const YamlNode& document, const std::vector<std::string>& known);
void refuse_unknown_stage_keys(const YamlNode& stage, const std::vector<std::string>& known);

}  // namespace flowslide
