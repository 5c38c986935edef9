#pragma once
#include "core/conventions.hpp"
#include "core/verification.hpp"

/// The cases, one function each; their files say what is computed.
namespace flowslide::section {

inline constexpr double kDegree = kPi / 180.0;  ///< [rad]

std::vector<Check> verify_fredlund_krahn(std::string_view name);
std::vector<Check> verify_taylor(std::string_view name);
std::vector<Check> verify_griffiths_lane(std::string_view name);
std::vector<Check> verify_mochikoshi(std::string_view name);

}  // namespace flowslide::section
