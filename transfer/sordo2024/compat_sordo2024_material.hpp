#pragma once
#include "transfer/sordo2024/compat_sordo2024.hpp"

#include <array>
#include <optional>

/// Materials and state variables by the rules of the script; used by compat_sordo2024.cpp only.
/// Defect numbers (S..) as in sordo2024_defects().
namespace flowslide {

/// All of one point that decides its material.
struct SordoPoint {
  Vec2 x;  ///< before the base shift [m] (S12)
  double r_u;
  double sigma_v;        ///< of the element after gravity, tension positive [Pa] (S09)
  int element_material;  ///< tag
};

/// Tag for the runout; empty where the script assigns none (S10).
std::optional<int> sordo_runout_tag(const SordoConfig& config, const SordoPoint& point);

/// svars_0 = tan(phi) and svars_2 = c [Pa] of a tag after the total deviatoric strain eps_q; zero
/// for a tag without strength.
std::array<double, 2> sordo_softened(const SordoConfig& config, int tag, double eps_q);

/// Law and parameters of a tag as the script's users give them to the runout program.
MaterialSpec sordo_material(const SordoConfig& config, int tag);

/// The row whose first entry is the tag, or null.
const std::vector<double>* find_row(const std::vector<std::vector<double>>& rows, int tag);

}  // namespace flowslide
