#include "core/check.hpp"
#include "workflows/engine/cache.hpp"
#include "workflows/stages/cross_checks.hpp"

#include <algorithm>

namespace flowslide {

void check_strength(const StrengthConfig& strength, Findings& found) {
  // Liquefied soil keeps 0.03 to 0.3 of its initial effective stress; sand that has not liquefied
  // has 0.6 to 0.8. Near the surface the ratio says nothing.
  constexpr double kShallow = 10e3, kHigh = 0.5, kLow = 0.01;
  for (std::size_t i = 0; i < strength.table.size(); ++i) {
    const double stress = strength.table[i][0], s = strength.table[i][1], ratio = s / stress;
    if (s > kShallow && ratio > 1.0) {
      found.errors.push_back(fmt::format(
          "strength.table row {}: S_r of {:g} kPa at sigma'_v0 of {:g} kPa is {:.3g} times the "
          "stress (liquefied soil keeps 0.03 to 0.3 of it, and no sand has more than 1) check the "
          "units",
          i + 1, s / 1e3, stress / 1e3, ratio));
    } else if (stress >= kShallow && !(ratio >= kLow && ratio <= kHigh)) {
      found.warnings.push_back(fmt::format(
          "strength.table row {}: S_r of {:g} kPa at sigma'_v0 of {:g} kPa is {:.3g} times the "
          "stress; liquefied soil keeps 0.03 to 0.3 of it.",
          i + 1, s / 1e3, stress / 1e3, ratio));
    }
  }
}

void check_pond(const TransferRuleConfig& rule, const QuadMesh& mesh, Findings& found) {
  double bottom = std::numeric_limits<double>::infinity(), top = -bottom;
  for (std::size_t e = 0; e < mesh.num_elements(); ++e) {
    if (std::find(rule.liquefiable.begin(), rule.liquefiable.end(), mesh.element_material[e]) ==
        rule.liquefiable.end())
      continue;
    for (const Vec2& p : corners(mesh, mesh.nodes, e)) {
      bottom = std::min(bottom, p[1]);
      top = std::max(top, p[1]);
    }
  }
  const double height = top - bottom;
  if (!(height > 0.0)) return;
  if (rule.pond_surface <= bottom + 1e-9 * height)
    found.warnings.push_back(fmt::format(
        "pond_surface: y = {:g} m does not lie above the bottom of the liquefiable soil at {:g} m: "
        "all depths of liquefaction will be 0.",
        rule.pond_surface, bottom));
  else if (rule.pond_surface > top + height)
    found.warnings.push_back(
        fmt::format("pond_surface: y = {:g} m lies {:g} m above the liquefiable soil, which is "
                    "{:g} m high: all "
                    "depths of liquefaction count from there.",
                    rule.pond_surface, rule.pond_surface - top, height));
}

void compare_transfer_rules(const StopAtTransferConfig& stop, const ZoneConfig& zone,
                            Findings& found) {
  const std::string changes =
      describe_changes(canonical_text(static_cast<const TransferRuleConfig&>(stop)),
                       canonical_text(static_cast<const TransferRuleConfig&>(zone)));
  if (!changes.empty())
    found.warnings.push_back(fmt::format(
        "the shaking ends by another rule than the one that chooses the transfer here: from "
        "stop_at_transfer of fem.run to this stage {}. The time chosen may be another than with "
        "the "
        "whole shaking.",
        changes));
}

void check_map_tags(const MapConfig& map, const SectionMesh& section,
                    const std::optional<ZoneConfig>& zone, Findings& found) {
  std::map<int, const MapMaterial*> of_tag;
  for (const auto& [name, m] : map.materials)
    for (const int tag : m.tags) of_tag[tag] = &m;
  const QuadMesh& mesh = section.mesh;
  for (std::size_t e = 0; e < mesh.num_elements(); ++e) {
    const Vec2 c = centroid(corners(mesh, mesh.nodes, e));
    const auto& b = map.box;
    if (b.size() == 4 && !(c[0] > b[0] && c[0] < b[1] && c[1] > b[2] && c[1] < b[3])) continue;
    if (of_tag.count(mesh.element_material[e]) > 0) continue;
    found.errors.push_back(fmt::format(
        "materials: element {} has the material tag {}, which no material lists (its mass and law "
        "are unknown) add the tag to the tags of a material, or leave the element outside the box",
        mesh.element_tags[e], mesh.element_material[e]));
    break;
  }
  if (!zone) return;
  for (const int tag : zone->liquefiable) {
    const auto at = of_tag.find(tag);
    if (at == of_tag.end() || at->second->liquefied) continue;
    const std::string problem = fmt::format(
        "materials: soil with the tag {} can liquefy (transfer.zone), but has no law for it", tag);
    if (zone->zone == ZoneExtent::all)
      found.errors.push_back(problem +
                             " (its strength would be that of intact soil) add liquefied: "
                             "{youngs_modulus: ..., poisson_ratio: ...} to it");
    else
      found.warnings.push_back(problem + ": should it liquefy, the transfer will be refused.");
  }
}

void check_size(const QuadMesh& mesh, Findings& found) {
  Extent e;
  const auto add = [&](Vec2 p) {
    e.left = std::min(e.left, p[0]);
    e.right = std::max(e.right, p[0]);
    e.bottom = std::min(e.bottom, p[1]);
    e.top = std::max(e.top, p[1]);
  };
  for (const Vec2& p : mesh.nodes) add(p);
  constexpr double kLargest = 1e5, kLarge = 1e4, kSmall = 0.5;  // [m]
  const double size = std::max(e.right - e.left, e.height());
  const std::string span = fmt::format(
      "the section spans x = {:.4g} to {:.4g} m and y = {:.4g} to "
      "{:.4g} m",
      e.left, e.right, e.bottom, e.top);
  if (!(size < kLargest))
    found.errors.push_back(fmt::format(
        "{} (no dam is larger than 100 km; a misplaced node, or another unit of length) check the "
        "coordinates and their unit",
        span));
  else if (size > kLarge)
    found.warnings.push_back(span + ", more than 10 km. Is the unit of length right?");
  else if (size < kSmall)
    found.warnings.push_back(span + ", less than half a metre. Is the unit of length right?");
}

}  // namespace flowslide
