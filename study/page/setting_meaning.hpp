#pragma once
#include "study/plan/plan.hpp"

#include <string>
#include <string_view>

namespace flowslide::study {

/// What the manual says of a setting such as `stages.map.with.c_soft_ratio`; empty where no stage
/// of the plan has it.
std::string setting_meaning(const Plan& plan, std::string_view setting);

}  // namespace flowslide::study
