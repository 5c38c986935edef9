#include "core/check.hpp"
#include "core/elementary.hpp"
#include "mpm/walls/height_field.hpp"
#include "workflows/stages/cross_checks.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

namespace flowslide {
namespace {

/// How far a place of the scene lies beyond the nodes of the map, eastward and northward [m].
struct Beyond {
  double east = 0.0, north = 0.0;
  [[nodiscard]] double size() const { return hypot(east, north); }
};

Beyond beyond(const mpm::HeightField& f, double x, double y) {
  const double c = cos(f.place.heading), s = sin(f.place.heading);
  const double east = f.place.origin[0] + c * x - s * y;
  const double north = f.place.origin[1] + s * x + c * y;
  const auto out = [](double at, double low, double high) {
    return at < low ? at - low : at > high ? at - high : 0.0;
  };
  return {out(east, f.corner[0], f.corner[0] + (f.columns - 1) * f.spacing),
          out(north, f.corner[1], f.corner[1] + (f.rows - 1) * f.spacing)};
}

/// Whole metres, as far as a number has so many.
std::string metres(double length) {
  return length < 1e9 ? fmt::format("{:.0f} m", length) : fmt::format("{:.3g} m", length);
}

/// "512276 m west and 30 m south of"
std::string direction(const Beyond& b) {
  std::vector<std::string> parts;
  if (b.east != 0.0) parts.push_back(metres(std::abs(b.east)) + (b.east < 0 ? " west" : " east"));
  if (b.north != 0.0)
    parts.push_back(metres(std::abs(b.north)) + (b.north < 0 ? " south" : " north"));
  return fmt::format("{} of", fmt::join(parts, " and "));
}

/// False if the soil does not lie on the map.
bool check_cover(const mpm::HeightField& f, const Extent& e, double width, Findings& found) {
  Beyond worst, least{std::numeric_limits<double>::infinity(), 0.0};
  for (const double x : {e.left, e.right})
    for (const double y : {0.0, width}) {
      const Beyond b = beyond(f, x, y);
      if (b.size() > worst.size()) worst = b;
      if (b.size() < least.size()) least = b;
    }
  if (!(worst.size() > 0.5 * f.spacing)) return true;
  const bool apart = least.size() > 0.0;
  found.errors.push_back(fmt::format(
      "ground.terrain: the soil at x = {:g} to {:g} m lies {}{} the map of {}, which spans {:.8g} "
      "to "
      "{:.8g} and {:.8g} to {:.8g} m (the ground under it would be made up) check origin, heading "
      "and the unit of the map",
      e.left, e.right, apart ? "" : "up to ", direction(apart ? least : worst), f.source,
      f.corner[0], f.corner[0] + (f.columns - 1) * f.spacing, f.corner[1],
      f.corner[1] + (f.rows - 1) * f.spacing));
  return false;
}

void check_heights(const mpm::HeightField& f, const FlowConfig& flow, const Soil& soil,
                   double width, Findings& found) {
  for (const Vec2& c : soil.centres) {
    for (const double y : {0.25 * width, 0.5 * width, 0.75 * width}) {
      const double above = c[1] - f.at(c[0], y);
      if (std::isnan(above)) {
        found.errors.push_back(fmt::format(
            "ground.terrain: under the soil at ({:.6g}, {:.6g}) m the terrain has no height, see "
            "{} "
            "(it would fall for ever) fill the gap in the file, or check origin and heading",
            c[0], y, f.name_place(c[0], y)));
        return;
      }
      if (above < -0.5 * flow.cell) {
        found.errors.push_back(fmt::format(
            "ground.terrain: soil at x = {:.6g} m, height {:.6g} m lies {:.3g} m below the terrain "
            "(it would be thrown out) check level, or raise the box of the transfer",
            c[0], c[1], -above));
        return;
      }
    }
  }
  check_hanging(
      "ground.terrain", [&](double x) { return f.at(x, 0.5 * width); }, flow, soil,
      "Is `level` right, and the place on the map?", found);
}

/// One height far below or above all others, which marks of missing data are: 0 among hundreds.
void check_marks(const mpm::HeightField& f, Findings& found) {
  constexpr double kLeast = 20.0, kShare = 0.25;  // [m], of the range of the others
  const auto look = [&](double sign) {
    double outermost = std::numeric_limits<double>::infinity(), next = outermost;
    double other_end = -outermost;
    for (const double height : f.height) {
      const double h = sign * height;
      if (h < outermost) next = std::exchange(outermost, h);
      if (h > outermost && h < next) next = h;
      if (h > other_end) other_end = h;
    }
    const double gap = next - outermost;
    if (!(std::isfinite(next) && gap > kLeast && gap > kShare * (other_end - next))) return;
    const auto count = std::count(f.height.begin(), f.height.end(), sign * outermost);
    if (2 * count > std::ssize(f.height)) return;  // the others are the odd ones
    found.warnings.push_back(fmt::format(
        "ground.terrain: {} of {} heights of {} are {:g} m, {:.4g} m {} all others. If they are a "
        "mark for missing data, write it into the header as nodata_value.",
        count, f.height.size(), f.source, sign * outermost, gap, sign > 0.0 ? "below" : "above"));
  };
  look(1.0);
  look(-1.0);
}

}  // namespace

void check_terrain(const FlowConfig& flow, const Soil& soil, Findings& found) {
  if (flow.extrude && flow.extrude->width < flow.cell)
    found.warnings.push_back(fmt::format(
        "extrude.width: {:g} m is less than a cell of {:g} m: the walls of both sides hold the "
        "same nodes. Take a wider valley, or smaller cells.",
        flow.extrude->width, flow.cell));
  if (!flow.ground.terrain) return;
  if (flow.ground.surface != GroundSettings{}.surface)
    found.errors.emplace_back(
        "ground.surface: and ground.terrain are both given (the ground is one of them) remove one");
  if (!flow.extrude)
    found.errors.emplace_back(
        "ground.terrain: is a surface in three dimensions, but there is no `extrude` (a run in "
        "plane "
        "strain has no use for it) give ground.surface, or extrude");
  const TerrainSettings& t = *flow.ground.terrain;
  const mpm::HeightField f = [&] {
    try {
      return mpm::read_height_field(t.file.path, {t.origin, t.heading, t.level});
    } catch (const InputError& e) {
      throw InputError(fmt::format("ground.terrain.file: {}", e.what()));
    }
  }();
  const auto missing =
      std::count_if(f.height.begin(), f.height.end(), [](double h) { return std::isnan(h); });
  if (missing > 0)
    found.warnings.push_back(fmt::format(
        "ground.terrain: {} of {} heights of {} are missing. A flow that comes there ends the run.",
        missing, f.height.size(), f.source));
  check_marks(f, found);
  if (soil.all.empty() || !flow.extrude) return;
  const double width = flow.extrude->width;
  if (!check_cover(f, soil.all, width, found)) return;
  check_heights(f, flow, soil, width, found);
  if (f.spacing > 3.0 * soil.all.height())
    found.warnings.push_back(fmt::format(
        "ground.terrain: {} has a height every {:g} m only, and the dam is {:.3g} m high: between "
        "them the ground is straight. Take a finer map.",
        f.source, f.spacing, soil.all.height()));
  // Runouts of ten heights are common; beyond its edges the terrain goes on level.
  const double reach = 10.0 * soil.all.height();
  for (double x = soil.all.right; x < soil.all.right + reach; x += f.spacing)
    if (beyond(f, x, 0.5 * width).size() > 0.5 * f.spacing) {
      found.warnings.push_back(fmt::format(
          "ground.terrain: the map of {} ends {:.4g} m downstream of the soil, less than ten times "
          "its height; beyond, the ground is taken as level.",
          f.source, x - soil.all.right));
      return;
    }
}

}  // namespace flowslide
