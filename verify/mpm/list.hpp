#pragma once
#include "core/verification.hpp"

/// The cases, one function each; their files say what is computed.
namespace flowslide::mpm {

std::vector<Check> verify_compaction(std::string_view name);
std::vector<Check> verify_mirror(std::string_view name);
std::vector<Check> verify_bar(std::string_view name);
std::vector<Check> verify_incline(std::string_view name);
std::vector<Check> verify_terrain(std::string_view name);
std::vector<Check> verify_impact(std::string_view name);
std::vector<Check> verify_rotation(std::string_view name);
std::vector<Check> verify_rest(std::string_view name);
std::vector<Check> verify_cantilever(std::string_view name);
std::vector<Check> verify_bui(std::string_view name);
std::vector<Check> verify_columns_short(std::string_view name);
std::vector<Check> verify_columns_plane(std::string_view name);
std::vector<Check> verify_columns_channel(std::string_view name);
std::vector<Check> verify_columns_round(std::string_view name);
std::vector<Check> verify_undrained(std::string_view name);
std::vector<Check> verify_cut(std::string_view name);
std::vector<Check> verify_prandtl(std::string_view name);
std::vector<Check> verify_prandtl_mc(std::string_view name);
std::vector<Check> verify_slope(std::string_view name);
std::vector<Check> verify_wave(std::string_view name);
std::vector<Check> verify_vortex(std::string_view name);
std::vector<Check> verify_infinite_slope(std::string_view name);
std::vector<Check> verify_sheet_flow(std::string_view name);
std::vector<Check> verify_valley(std::string_view name);
std::vector<Check> verify_crossing(std::string_view name);
std::vector<Check> verify_ringing(std::string_view name);
std::vector<Check> verify_sparse(std::string_view name);
std::vector<Check> verify_stretch(std::string_view name);
std::vector<Check> verify_rejoin(std::string_view name);
std::vector<Check> verify_weak(std::string_view name);
std::vector<Check> verify_contrast(std::string_view name);
std::vector<Check> verify_hit(std::string_view name);
std::vector<Check> verify_corner(std::string_view name);
std::vector<Check> verify_locking(std::string_view name);
std::vector<Check> verify_leaving(std::string_view name);
std::vector<Check> verify_extremes(std::string_view name);
std::vector<Check> verify_return_maps(std::string_view name);

}  // namespace flowslide::mpm
