#pragma once
#include "core/verification.hpp"

/// Verification of the finite-element solver: docs/theory/verification-fem.md
namespace flowslide {

/// All cases of the group "fem".
std::vector<VerificationCase> fem_cases();

}  // namespace flowslide
