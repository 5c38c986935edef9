#include "core/conventions.hpp"
#include "fem/build_model.hpp"
#include "workflows/stages/cross_checks.hpp"

#include <algorithm>
#include <cmath>

/// Whether shaking can liquefy what is called liquefiable: a runout of 0 m that comes from dry sand
/// or of a wrong unit looks like that of a safe dam.
namespace flowslide {
namespace {

/// How far the water stands above the lowest element of a material, at most [m]; negative: dry.
double water_over(const FemConfig& fem, const QuadMesh& mesh, std::int32_t tag) {
  double most = -std::numeric_limits<double>::infinity();
  for (std::size_t e = 0; e < mesh.num_elements(); ++e) {
    if (mesh.element_material[e] != tag) continue;
    const Vec2 c = centroid(corners(mesh, mesh.nodes, e));
    most = std::max(most, fem::water_level(*fem.water, c[0]) - c[1]);
  }
  return most;
}

std::string law_of(const FemMaterialConfig& m) {
  std::string law;
  ShakingLaws::each([&]<class M>() {
    if (m.laws.of<M>()) law = M::name;
  });
  return law;
}

}  // namespace

void check_liquefiable(const FemConfig& fem, const TransferRuleConfig& rule,
                       const SectionMesh& section, Findings& found) {
  // Coarse sand and gravel. A dam of 8 m still liquefies with 1e-3 m/s, and not with 0.05 m/s.
  constexpr double kDrains = 2e-3;
  for (const std::string& name : rule.liquefiable) {
    const auto at = fem.materials.find(name);
    if (at == fem.materials.end()) continue;
    const FemMaterialConfig& m = at->second;
    std::string why;
    if (!fem.water)
      why = "fem.run has no `water`: dry soil cannot liquefy.";
    else if (const double over = water_over(fem, section.mesh, material_tag(section, name));
             !(over > 0.0))
      why = fmt::format(
          "water.table of fem.run passes {:.3g} m below all of it: dry soil cannot liquefy.",
          -over);
    else if (m.drained)
      why = "it is `drained` in fem.run: no pore pressure gathers in it.";
    else if (!m.laws.of<PM4Sand>())
      why = fmt::format(
          "its law in fem.run is {}, which gathers no pore pressure in cycles of shear; pm4sand "
          "does.",
          law_of(m));
    if (!why.empty()) {
      warn(found,
           "liquefiable: '{}' cannot liquefy: {} The runout will be that of a dam that nothing "
           "weakens.",
           name, why);
      continue;
    }
    const double k = std::max(m.permeability[0], m.permeability[1]);
    if (k > kDrains)
      warn(found,
           "liquefiable: '{}' has a permeability of {:.3g} m/s in fem.run, that of gravel: water "
           "leaves it while it is shaken, and little or nothing liquefies. In cm/s sand has 1e-3 "
           "to 1e-1, silty tailings less than 1e-4; is the unit right?",
           name, k);
  }
}

std::string how_near(const LiquefactionZone& zone, const RuConfig& r_u) {
  double most = kUnset;
  for (const double r : zone.r_u_node)
    if (is_set(r) && !(most >= r)) most = r;
  if (!is_set(most))
    return fmt::format(" No node has an r_u, as none has {:g} kPa of vertical effective stress.",
                       r_u.floor / 1e3);
  return fmt::format(
      " The largest r_u is {:.2g}, where soil counts as liquefied above {:g}. If that is little for "
      "so strong a shaking, look at its peak, permeability, the water table and the soil's law.",
      most, r_u.threshold);
}

}  // namespace flowslide
