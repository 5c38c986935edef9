#include "core/check.hpp"
#include "workflows/stages/cross_checks.hpp"

#include <algorithm>
#include <cmath>

/// Where a runout takes place.
namespace flowslide {
namespace {

void add(Extent& extent, Vec2 p) {
  extent.left = std::min(extent.left, p[0]);
  extent.right = std::max(extent.right, p[0]);
  extent.bottom = std::min(extent.bottom, p[1]);
  extent.top = std::max(extent.top, p[1]);
}

/// Height of the polyline at x, the lower one at a step; level beyond its ends.
double ground_height(const std::vector<std::vector<double>>& surface, double x) {
  double lowest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < surface.size(); ++i) {
    const bool first = i == 0 && x <= surface[i][0];
    const bool last = i + 1 == surface.size() && x >= surface[i][0];
    if (first || last || surface[i][0] == x) lowest = std::min(lowest, surface[i][1]);
    if (i == 0 || !(x > surface[i - 1][0] && x < surface[i][0])) continue;
    const double share = (x - surface[i - 1][0]) / (surface[i][0] - surface[i - 1][0]);
    lowest = std::min(lowest, surface[i - 1][1] + share * (surface[i][1] - surface[i - 1][1]));
  }
  return lowest;
}

/// Height of the soil within a twentieth of its length from x.
double height_near(double x, const Soil& soil) {
  const Extent& e = soil.counted;
  double top = e.bottom;
  for (const Vec2& c : soil.centres)
    if (std::abs(c[0] - x) <= 0.05 * (e.right - e.left)) top = std::max(top, c[1]);
  return top - e.bottom;
}

/// Flows are followed towards larger x.
void check_direction(const Soil& soil, Findings& found) {
  const Extent& e = soil.counted;
  if (e.empty()) return;
  if (height_near(e.right, soil) > 0.5 * e.height() &&
      height_near(e.left, soil) < 0.25 * e.height())
    warn(found,
         "the soil is high at its right end, x = {:g} m, and runs out at its left, x = {:g} m: "
         "flows go to the right, and the runout counts from the right end. Is the section drawn "
         "with its toe on the left? `mirror` of the import turns it around; in a section of blocks "
         "give every x the other sign.",
         e.right, e.left);
}

/// Soil behind an absorbing plane has nothing that holds it.
void check_absorbing(const FlowConfig& flow, const Soil& soil, Findings& found) {
  const AbsorbingSettings& a = flow.absorbing;
  const auto refuse_if = [&](const char* side, const std::optional<double>& at, auto beyond) {
    if (!at) return;
    const auto c = std::find_if(soil.centres.begin(), soil.centres.end(), beyond);
    if (c != soil.centres.end())
      refuse(found,
             "absorbing.{}: {:g} m lies inside the soil, as there is soil beyond it at ({:.4g}, "
             "{:.4g}) m (nothing would hold it) move the plane or the box of the transfer",
             side, *at, (*c)[0], (*c)[1]);
  };
  refuse_if("left", a.left, [&](const Vec2& c) { return c[0] < *a.left; });
  refuse_if("right", a.right, [&](const Vec2& c) { return c[0] > *a.right; });
  refuse_if("bottom", a.bottom, [&](const Vec2& c) { return c[1] < *a.bottom; });
}

/// Ground that a flow cannot climb, near the toe.
void check_rise(const FlowConfig& flow, const Soil& soil, Findings& found) {
  const Extent& e = soil.counted;
  if (e.empty()) return;
  constexpr double kReach = 10.0, kHigh = 0.5;  // heights of the soil
  const double toe = ground_height(flow.ground.surface, e.right + 1e-6 * e.height());
  const double end = e.right + kReach * e.height();
  double most = -std::numeric_limits<double>::infinity(), where = end;
  const auto look = [&](double x, double y) {
    if (!(y > most)) return;
    most = y;
    where = x;
  };
  for (const auto& p : flow.ground.surface)
    if (p[0] > e.right && p[0] <= end) look(p[0], p[1]);
  look(end, ground_height(flow.ground.surface, end));
  if (std::isfinite(toe) && most - std::max(toe, e.bottom) > kHigh * e.height())
    warn(
        found,
        "ground.surface: rises to y = {:.6g} m at x = {:.6g} m, {:.3g} m above the toe of soil {:.3g} "
        "m high: the flow ends there. Are heights and their datum those of the section?",
        most, where, most - std::max(toe, e.bottom), e.height());
}

}  // namespace

Soil soil_of(const SectionMesh& section, const MapConfig& config,
             const std::vector<HistoryMaterial>& materials) {
  Soil soil;
  const QuadMesh& mesh = section.mesh;
  const Box box = box_of(config.box);
  std::map<std::int32_t, bool> counts;
  for (const auto& [name, material] : config.materials)
    for (const std::string& source : sources_of(name, material))
      counts[find_material(materials, source, "materials." + name).tag] =
          material.counts_for_runout;
  for (std::size_t e = 0; e < mesh.num_elements(); ++e) {
    const auto found = counts.find(mesh.element_material[e]);
    if (found == counts.end()) continue;
    const std::array<Vec2, 4> quad = corners(mesh, mesh.nodes, e);
    if (found->second)
      for (const Vec2& p : quad) add(soil.uncut, p);
    const Vec2 centre = centroid(quad);
    const bool inside = centre[0] > box.xmin && centre[0] < box.xmax && centre[1] > box.ymin &&
                        centre[1] < box.ymax;
    if (!inside) continue;
    soil.area += area(quad);
    soil.largest = std::max(soil.largest, area(quad));
    soil.centres.push_back(centre);
    Vec2& foot = soil.feet.emplace_back(centre);
    for (const Vec2& p : quad) {
      const Vec2 clamped{std::clamp(p[0], box.xmin, box.xmax),
                         std::clamp(p[1], box.ymin, box.ymax)};
      foot[1] = std::min(foot[1], clamped[1]);
      add(soil.all, clamped);
      if (found->second) add(soil.counted, clamped);
    }
  }
  return soil;
}

void check_toe(double toe, const FlowConfig& flow, const Soil& soil, Findings& found) {
  const Extent& e = soil.counted;
  if (e.empty()) return;
  constexpr double kFarthest = 100.0;  // heights; the longest known flows go some tens
  const double beyond = toe - e.right;
  if (beyond > kFarthest * e.height())
    refuse(found,
           "toe: x = {:g} m lies {:g} m beyond the downstream end of the soil at x = {:g} m, more "
           "than {:g} times its height of {:g} m (nothing would pass it and the runout would be 0 "
           "whatever happens) give the x of the toe of the section",
           toe, beyond, e.right, kFarthest, e.height());
  else if (beyond > std::max(0.2 * e.height(), 2.0 * flow.cell))
    warn(found,
         "toe: x = {:g} m lies {:g} m beyond the downstream end of the soil at x = {:g} m. The "
         "runout is counted from there: a flow of up to {:g} m will be reported as 0.",
         toe, beyond, e.right, beyond);
  if (toe <= e.left || -beyond > e.height())
    refuse(
        found,
        "toe: x = {:g} m lies {:g} m inside the soil, which ends at x = {:g} m and is {:g} m "
        "high (so much would count as runout before anything moves) give the x of the toe of "
        "the section; where soil goes on beyond the toe, as level ground does, make it a material "
        "of its own with `counts_for_runout: false`",
        toe, -beyond, e.right, e.height());
  else if (-beyond > flow.cell)
    warn(found,
         "toe: x = {:g} m lies {:g} m inside the soil, which ends at x = {:g} m: so much counts as "
         "runout before anything moves.",
         toe, -beyond, e.right);
}

void check_box(const MapConfig& map, const Soil& soil, Findings& found) {
  if (soil.counted.empty()) return;
  if (soil.counted.right < soil.uncut.right - 0.5 * map.cell)
    warn(found,
         "box.right: x = {:g} m cuts through the soil that counts for the runout, which goes on to "
         "x = {:g} m: what lies beyond is not there to hold it back.",
         soil.counted.right, soil.uncut.right);
  if (soil.counted.top < soil.uncut.top - 0.5 * map.cell)
    warn(found,
         "box.top: y = {:g} m cuts through the soil that counts for the runout, which is {:g} m "
         "higher: the weight of what lies above is not there.",
         soil.counted.top, soil.uncut.top - soil.counted.top);
}

void check_tractions(const FlowConfig& flow, const Soil& soil, Findings& found) {
  constexpr double kUnitWeight = 20e3;  // of wet soil [N/m3]
  constexpr double kOdd = 20.0, kImpossible = 1000.0;
  if (soil.all.empty()) return;
  const double weight = kUnitWeight * soil.all.height();
  for (std::size_t i = 0; i < flow.tractions.size(); ++i) {
    const double load =
        std::max(std::abs(flow.tractions[i].pressure), std::abs(flow.tractions[i].shear));
    if (load > kImpossible * weight)
      refuse(found,
             "tractions[{}]: {:.3g} Pa, more than {:g} times the weight of {:g} m of soil (nothing "
             "built or poured weighs that much) check number and unit",
             i, load, kImpossible, soil.all.height());
    else if (load > kOdd * weight)
      warn(found,
           "tractions[{}]: {:.3g} Pa, {:.0f} times the weight of {:g} m of soil: the load will "
           "throw the soil about.",
           i, load, load / weight, soil.all.height());
  }
}

void check_edges(const FlowConfig& flow, const Soil& soil, Findings& found) {
  const Extent& e = soil.all;
  check_direction(soil, found);
  if (e.empty()) return;
  const double slack = 0.5 * flow.cell, toe = soil.counted.right;
  if (flow.left_roller && *flow.left_roller > e.left + slack)
    refuse(found,
           "left_roller: x = {:g} m lies inside the soil, which begins at x = {:g} m (what is "
           "behind the wall would be pushed about) put it at the end of the soil",
           *flow.left_roller, e.left);
  else if (flow.left_roller && *flow.left_roller < e.left - 2.0 * flow.cell)
    warn(found,
         "left_roller: x = {:g} m lies {:g} m upstream of the soil, which begins at x = {:g} m: "
         "its upstream end stands free and can fall towards the wall.",
         *flow.left_roller, e.left - *flow.left_roller, e.left);
  if (flow.right_roller && *flow.right_roller < e.right - slack)
    refuse(found,
           "right_roller: x = {:g} m lies inside the soil, which ends at x = {:g} m (what is "
           "behind the wall would be pushed about) put it beyond the soil",
           *flow.right_roller, e.right);
  else if (flow.right_roller && *flow.right_roller <= toe)
    warn(found,
         "right_roller: x = {:g} m does not lie beyond the toe at x = {:g} m: nothing can pass the "
         "toe and the runout will be 0.",
         *flow.right_roller, toe);
  const OutletSettings& o = flow.outlet;
  const auto leaves = [&](const char* side, const std::optional<double>& at, bool outside) {
    if (at && outside)
      refuse(found,
             "outlet.{}: {:g} m lies inside the soil, which spans x = {:g} to {:g} m and y = {:g} "
             "to {:g} m (part of it would leave before it moves) put it beyond the soil",
             side, *at, e.left, e.right, e.bottom, e.top);
  };
  leaves("left", o.left, o.left && *o.left > e.left + slack);
  leaves("right", o.right, o.right && *o.right < e.right - slack);
  leaves("bottom", o.bottom, o.bottom && *o.bottom > e.bottom + slack);
  leaves("top", o.top, o.top && *o.top < e.top - slack);
  check_absorbing(flow, soil, found);
  if (o.right && *o.right >= e.right - slack && *o.right <= toe)
    refuse(found,
           "outlet.right: x = {:g} m does not lie beyond the toe at x = {:g} m (points count where "
           "they left, so the runout would be 0 whatever happens) put it downstream of the toe",
           *o.right, toe);
}

void check_ground(const FlowConfig& flow, const Soil& soil, Findings& found) {
  if (flow.ground.terrain || flow.absorbing.bottom || soil.centres.empty()) return;
  double deepest = 0.0;
  Vec2 where{};
  for (const Vec2& c : soil.centres) {
    const double above = c[1] - ground_height(flow.ground.surface, c[0]);
    if (-above > deepest) {
      deepest = -above;
      where = c;
    }
  }
  if (deepest > 0.5 * flow.cell)
    refuse(found,
           "ground.surface: soil at ({:.6g}, {:.6g}) m lies {:.3g} m below it (it would be thrown "
           "out) lower the surface or raise the box of the transfer",
           where[0], where[1], deepest);
  check_hanging(
      "ground.surface", [&](double x) { return ground_height(flow.ground.surface, x); }, flow, soil,
      fmt::format("Draw it along the bottom of the soil, and a step at the end, x = {:.6g} m.",
                  soil.all.right),
      found);
  check_rise(flow, soil, found);
}

void check_hanging(const std::string& setting, const std::function<double(double)>& height,
                   const FlowConfig& flow, const Soil& soil, const std::string& hint,
                   Findings& found) {
  if (!(soil.largest > 0.0)) return;
  const double element = std::sqrt(soil.largest), width = 2.0 * std::max(element, flow.cell);
  std::map<std::int64_t, Vec2> lowest;  // of each strip
  for (const Vec2& c : soil.feet) {
    const auto strip = static_cast<std::int64_t>(std::floor((c[0] - soil.all.left) / width));
    const auto at = lowest.try_emplace(strip, c).first;
    if (c[1] < at->second[1]) at->second = c;
  }
  double most = 0.0, least = std::numeric_limits<double>::infinity();
  Vec2 where{};
  for (const auto& [strip, c] : lowest) {
    const double above = c[1] - height(c[0]);
    if (std::isnan(above)) continue;  // no height there
    least = std::min(least, above);
    if (above > most) {
      most = above;
      where = c;
    }
  }
  // What falls less than a cell meets the ground at once: its points feel it from there on.
  const double free = std::max(flow.cell, element);
  if (most > free)
    warn(found,
         "{}: the lowest soil at x = {:.6g} m, y = {:.6g} m hangs {:.3g} m above it, and will fall "
         "before it flows{}. {}",
         setting, where[0], where[1], most,
         least > free ? fmt::format(", as all of the soil by {:.3g} m or more", least) : "", hint);
}

}  // namespace flowslide
