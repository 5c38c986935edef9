#pragma once
#include "core/verification.hpp"

/// Verification of limit equilibrium: docs/theory/limit-equilibrium.md
namespace flowslide {

/// All cases of the group "section".
std::vector<VerificationCase> section_cases();

}  // namespace flowslide
