#pragma once
#include "core/verification.hpp"

/// The cases, one function each; their files say what is computed.
namespace flowslide::section {

std::vector<Check> verify_fredlund_krahn(std::string_view name);
std::vector<Check> verify_taylor(std::string_view name);
std::vector<Check> verify_griffiths_lane(std::string_view name);
std::vector<Check> verify_mochikoshi(std::string_view name);

}  // namespace flowslide::section
