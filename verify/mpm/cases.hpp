#pragma once
#include "core/verification.hpp"

/// Verification of the material-point method: docs/theory/verification-mpm.md
namespace flowslide {

/// All cases of the group "mpm".
std::vector<VerificationCase> mpm_cases();

}  // namespace flowslide
