#include "core/check.hpp"
#include "workflows/stages/cross_checks.hpp"

#include <algorithm>

/// Softening, whose strains hold for one size of cells (docs/theory/softening.md).
namespace flowslide {
namespace {

bool softens(const MapMaterial& m, const MapConfig& map) {
  if (m.liquefied && m.liquefied->residual_strain > 0.0 && map.c_soft_ratio < 1.0) return true;
  const auto down = [](const auto& law) {
    return law && (law->residual_cohesion || law->residual_friction_angle) &&
           law->residual_strain > law->peak_strain;
  };
  return down(m.law.of<MohrCoulomb>()) || down(m.law.of<DruckerPrager>()) ||
         m.law.of<ResidualStrength>();
}

}  // namespace

void check_softening(const FlowConfig& flow, const MapConfig& map, const Soil& soil,
                     Findings& found) {
  const SofteningSettings& s = flow.softening;
  if (soil.counted.empty()) return;
  const auto first = std::find_if(map.materials.begin(), map.materials.end(),
                                  [&](const auto& m) { return softens(m.second, map); });
  if (first == map.materials.end()) return;
  if (!s.regularise) {
    warn(found,
         "softening.regularise: false: '{}' softens, and half the cell then takes its strength "
         "after half the slip: the runout is that of cells of {:g} m, and smaller ones do not "
         "bring it nearer to anything.",
         first->first, flow.cell);
    return;
  }
  if (!s.reference_length) {
    refuse(found, "{}", no_reference_length(first->first, flow.cell));
    return;
  }
  // As for the cells themselves, between fewer than four there is no slip surface.
  constexpr double kShare = 0.25, kMostShortened = 10.0;
  const double stretched = *s.reference_length / flow.cell;
  if (*s.reference_length > kShare * soil.counted.height())
    warn(found,
         "softening.reference_length: strains that hold in cells of {:g} m are those of no slip "
         "surface in soil {:g} m high; in cells of {:g} m they are stretched by {:.3g}, and the "
         "soil may never soften.",
         *s.reference_length, soil.counted.height(), flow.cell, stretched);
  else if (stretched * kMostShortened < 1.0)
    warn(found,
         "softening.reference_length: {:g} m is {:.3g} of a cell of {:g} m: strains of softening "
         "are shortened as much, and soil that deforms at all has its residual strength.",
         *s.reference_length, stretched, flow.cell);
}

}  // namespace flowslide
