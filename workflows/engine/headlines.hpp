#pragma once
#include "workflows/engine/stage.hpp"

#include <string>
#include <vector>

/// The few numbers that a run prints. A stage names them among its facts; the engine knows none.
namespace flowslide {

/// Facts with the headlines in them, as the array "headlines"; without any, as they are.
std::string add_headlines(const std::string& facts, const std::vector<Headline>& headlines);

/// Those of all stages: first those of the last stage that has any, which sums up, then those of
/// the stages before it that it does not name. `facts` in the order of the stages.
std::vector<Headline> merged_headlines(const std::vector<std::string>& facts);

/// Those of the text of a result.json.
std::vector<Headline> headlines_of(const std::string& result);

}  // namespace flowslide
