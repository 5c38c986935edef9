#pragma once
#include "core/verification.hpp"

/// The cases, one function each; their files say what is computed.
namespace flowslide::fem {

std::vector<Check> verify_patch(std::string_view name);
std::vector<Check> verify_terzaghi(std::string_view name);
std::vector<Check> verify_first_step(std::string_view name);
std::vector<Check> verify_mandel(std::string_view name);
std::vector<Check> verify_cylinder(std::string_view name);
std::vector<Check> verify_harmonic_column(std::string_view name);
std::vector<Check> verify_site_response(std::string_view name);
std::vector<Check> verify_reflection(std::string_view name);
std::vector<Check> verify_undrained(std::string_view name);
std::vector<Check> verify_cyclic_strength(std::string_view name);
std::vector<Check> verify_undrained_strength(std::string_view name);
std::vector<Check> verify_pm4sand_step(std::string_view name);
std::vector<Check> verify_implicit(std::string_view name);
std::vector<Check> verify_implicit_slope(std::string_view name);
std::vector<Check> verify_softening_length(std::string_view name);
std::vector<Check> verify_centrifuge(std::string_view name);
std::vector<Check> verify_rest(std::string_view name);
std::vector<Check> verify_bending(std::string_view name);
std::vector<Check> verify_hinge(std::string_view name);
std::vector<Check> verify_hostile(std::string_view name);

}  // namespace flowslide::fem
