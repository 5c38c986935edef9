#pragma once
#include "core/verification.hpp"

/// The cases, one function each; their files say what is computed.
namespace flowslide::mpm {

std::vector<Check> verify_compaction(std::string_view name);
std::vector<Check> verify_mirror(std::string_view name);

}  // namespace flowslide::mpm
