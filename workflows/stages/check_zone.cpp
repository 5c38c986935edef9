#include "core/check.hpp"
#include "model/outline.hpp"
#include "workflows/engine/cache.hpp"
#include "workflows/stages/cross_checks.hpp"

#include <algorithm>
#include <map>
#include <set>

namespace flowslide {
namespace {

/// Positive where its corners go round to the left.
double outline_area(const ReportRegion& region) {
  double area = 0.0;
  for (std::size_t i = 0; i < region.outline.size(); ++i) {
    const auto &a = region.outline[i], &b = region.outline[(i + 1) % region.outline.size()];
    area += 0.5 * (a[0] * b[1] - b[0] * a[1]);
  }
  return area;
}

std::string span_text(const Extent& e) {
  return fmt::format("x = {:.6g} to {:.6g} m and y = {:.6g} to {:.6g} m", e.left, e.right, e.bottom,
                     e.top);
}

}  // namespace

Extent extent_of(const QuadMesh& mesh) {
  Extent e;
  for (const Vec2& p : mesh.nodes) {
    e.left = std::min(e.left, p[0]);
    e.right = std::max(e.right, p[0]);
    e.bottom = std::min(e.bottom, p[1]);
    e.top = std::max(e.top, p[1]);
  }
  return e;
}

namespace {

void check_strengths(const std::string& key, const StrengthTable& table, Findings& found) {
  // Liquefied soil keeps 0.03 to 0.3 of its initial effective stress; sand that has not liquefied
  // has 0.6 to 0.8. Near the surface the ratio says nothing.
  constexpr double kShallow = 10e3, kHigh = 0.5, kLow = 0.01;
  for (std::size_t i = 0; i < table.size(); ++i) {
    const double stress = table[i][0], s = table[i][1], ratio = s / stress;
    if (s > kShallow && ratio > 1.0) {
      found.errors.push_back(fmt::format(
          "{} row {}: S_r of {:g} kPa at sigma'_v0 of {:g} kPa is {:.3g} times the "
          "stress (liquefied soil keeps 0.03 to 0.3 of it, and no sand has more than 1) check the "
          "units",
          key, i + 1, s / 1e3, stress / 1e3, ratio));
    } else if (stress >= kShallow && !(ratio >= kLow && ratio <= kHigh)) {
      found.warnings.push_back(
          fmt::format("{} row {}: S_r of {:g} kPa at sigma'_v0 of {:g} kPa is {:.3g} times the "
                      "stress; liquefied soil keeps 0.03 to 0.3 of it.",
                      key, i + 1, s / 1e3, stress / 1e3, ratio));
    }
    if (i > 0 && s < table[i - 1][1])
      found.warnings.push_back(
          fmt::format("{} row {}: S_r falls to {:g} kPa from {:g} kPa in the row before, under a "
                      "larger stress: deeper soil would be weaker. Are the columns in their order?",
                      key, i + 1, s / 1e3, table[i - 1][1] / 1e3));
  }
}

}  // namespace

void check_strength(const StrengthConfig& strength, Findings& found) {
  check_strengths("strength.table", strength.table, found);
  for (const auto& [name, own] : strength.materials)
    check_strengths(fmt::format("strength.materials.{}.table", name), own.table, found);
}

void check_r_u(const RuConfig& r_u, Findings& found) {
  constexpr double kLow = 0.5, kHigh = 1.0, kDeep = 30e3;  // [-], [-], [Pa]
  if (r_u.threshold >= kHigh)
    found.warnings.push_back(fmt::format(
        "r_u.threshold: {:g} is hardly ever exceeded, as soil without effective stress has 1: "
        "nothing may liquefy.",
        r_u.threshold));
  else if (r_u.threshold < kLow)
    found.warnings.push_back(fmt::format(
        "r_u.threshold: {:g} counts soil as liquefied that has most of its effective stress.",
        r_u.threshold));
  if (r_u.floor > kDeep)
    found.warnings.push_back(fmt::format(
        "r_u.floor: soil with less than {:g} kPa, down to some {:.1g} m, cannot count as liquefied.",
        r_u.floor / 1e3, r_u.floor / 10e3));
}

void check_pond(const TransferRuleConfig& rule, const QuadMesh& mesh,
                const std::vector<HistoryMaterial>& materials, Findings& found) {
  std::set<std::int32_t> liquefiable;
  for (const std::string& name : rule.liquefiable)
    liquefiable.insert(find_material(materials, name, "liquefiable").tag);
  double bottom = std::numeric_limits<double>::infinity(), top = -bottom;
  for (std::size_t e = 0; e < mesh.num_elements(); ++e) {
    if (liquefiable.count(mesh.element_material[e]) == 0) continue;
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
  else if (rule.pond_surface < top - 0.5 * height)
    found.warnings.push_back(fmt::format(
        "pond_surface: y = {:g} m lies {:.3g} m below the top of the liquefiable soil, which is "
        "{:.3g} m high: depths of liquefaction count from there, and what liquefies above it "
        "counts for nothing.",
        rule.pond_surface, top - rule.pond_surface, height));
  else if (rule.pond_surface > top + height)
    found.warnings.push_back(
        fmt::format("pond_surface: y = {:g} m lies {:g} m above the liquefiable soil, which is "
                    "{:g} m high: all "
                    "depths of liquefaction count from there.",
                    rule.pond_surface, rule.pond_surface - top, height));
}

void check_freeboard(double pond, const QuadMesh& mesh, std::optional<double> pond_surface,
                     Findings& found) {
  double bottom = std::numeric_limits<double>::infinity(), top = -bottom;
  for (const Vec2& p : mesh.nodes) {
    bottom = std::min(bottom, p[1]);
    top = std::max(top, p[1]);
  }
  // Tailings lie a little below the water, or some metres above it.
  constexpr double kFar = 0.2;
  if (pond > top)
    found.errors.push_back(fmt::format(
        "pond: {:g} m is above the highest ground at y = {:g} m (the freeboard would be "
        "negative before anything moves) check the level and its datum",
        pond, top));
  else if (pond <= bottom)
    found.errors.push_back(fmt::format(
        "pond: {:g} m is not above the bottom of the section at y = {:g} m (there is no pond) check "
        "the level and its datum",
        pond, bottom));
  else if (pond_surface && std::abs(pond - *pond_surface) > kFar * (top - bottom))
    found.warnings.push_back(fmt::format(
        "pond: {:g} m, but pond_surface of the zone is {:g} m. Do both count from one datum?", pond,
        *pond_surface));
}

void check_transfer_time(const TransferRuleConfig& rule, double end, std::string_view above,
                         Findings& found) {
  if (rule.transfer.at && *rule.transfer.at > end * (1.0 + 1e-9))
    found.errors.push_back(fmt::format(
        "{}at: {:g} s, but the shaking ends at {:g} s (there is no state to transfer) choose an "
        "earlier time or a later `end` of fem.run",
        above, *rule.transfer.at, end));
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
        "the whole shaking.",
        changes));
}

void check_map_names(const MapConfig& map, const SectionMesh& section,
                     const std::vector<HistoryMaterial>& materials,
                     const std::optional<ZoneConfig>& zone, Findings& found) {
  std::map<std::string, const MapMaterial*> of_name;
  for (const auto& [name, m] : map.materials)
    for (const std::string& source : sources_of(name, m)) of_name[source] = &m;
  std::map<std::int32_t, std::string> name_of;
  for (const HistoryMaterial& m : materials) name_of[m.tag] = m.name;
  const QuadMesh& mesh = section.mesh;
  const Box box = box_of(map.box);
  const Extent e = extent_of(mesh);
  if (!(box.xmin < e.right && box.xmax > e.left && box.ymin < e.top && box.ymax > e.bottom))
    found.errors.push_back(fmt::format(
        "box: holds no part of the section, which spans {} (there is nothing to transfer) check "
        "numbers and unit",
        span_text(e)));
  for (std::size_t i = 0; i < mesh.num_elements(); ++i) {
    if (!box.contains(centroid(corners(mesh, mesh.nodes, i)))) continue;
    const std::string& name = name_of[mesh.element_material[i]];
    if (of_name.count(name) > 0) continue;
    found.errors.push_back(fmt::format(
        "materials: element {} is of the material '{}', which is not among them (its law is "
        "unknown) add it, or leave the element outside the box",
        mesh.element_tags[i], name));
    break;
  }
  if (!zone) return;
  for (const std::string& name : zone->liquefiable) {
    const auto at = of_name.find(name);
    if (at == of_name.end() || at->second->liquefied) continue;
    const std::string problem =
        fmt::format("materials: '{}' can liquefy (transfer.zone), but has no law for it", name);
    if (zone->zone == ZoneExtent::all)
      found.errors.push_back(problem +
                             " (its strength would be that of intact soil) add liquefied: "
                             "{youngs_modulus: ..., poisson_ratio: ...} to it");
    else
      found.warnings.push_back(problem + ": should it liquefy, the transfer will be refused.");
  }
}

void check_region(const std::string& name, const ReportRegion& region, const QuadMesh& mesh,
                  Findings& found) {
  if (region.outline.size() < 3) {
    found.errors.push_back(
        fmt::format("regions.{}: {} corners (a region needs three or more) give its outline", name,
                    region.outline.size()));
    return;
  }
  if (std::abs(outline_area(region)) <= 0.0) {
    found.errors.push_back(fmt::format(
        "regions.{}: its corners lie on one line (nothing lies inside) give its outline", name));
    return;
  }
  if (mesh.nodes.empty()) return;
  const auto inside = [&](Vec2 p) { return inside_outline(region.outline, p); };
  for (std::size_t e = 0; e < mesh.num_elements(); ++e) {
    const std::array<Vec2, 4> quad = corners(mesh, mesh.nodes, e);
    if (std::ranges::any_of(quad, inside) || inside(centroid(quad))) return;
    for (const auto& corner : region.outline)  // a region within one element
      if (inside_outline(quad, {corner[0], corner[1]})) return;
  }
  found.warnings.push_back(
      fmt::format("regions.{}: holds no part of the section, which spans {}: nothing will be told "
                  "of it.",
                  name, span_text(extent_of(mesh))));
}

void check_size(const QuadMesh& mesh, Findings& found) {
  const Extent e = extent_of(mesh);
  constexpr double kLargest = 1e5, kLarge = 1e4, kHigh = 1e3, kSmall = 5.0;  // [m]
  constexpr double kColumn = 10.0;  // a column of soil may be higher than wide [m]
  const double size = std::max(e.right - e.left, e.height());
  const std::string span = "the section spans " + span_text(e);
  if (!(size < kLargest))
    found.errors.push_back(fmt::format(
        "{} (no dam is larger than 100 km; a misplaced node, or another unit of length) check the "
        "coordinates and their unit",
        span));
  else if (size > kLarge)
    found.warnings.push_back(span + ", more than 10 km. Is the unit of length right?");
  else if (e.height() > kHigh)
    found.warnings.push_back(span + ", more than a kilometre high. Is the unit of length right?");
  else if (size < kSmall)
    found.warnings.push_back(span + ", less than 5 m. Is the unit of length right?");
  else if (e.right - e.left > kColumn && e.height() > e.right - e.left)
    found.warnings.push_back(span + ": it is higher than long. Are x and y exchanged?");
}

}  // namespace flowslide
