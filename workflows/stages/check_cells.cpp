#include "core/check.hpp"
#include "transfer/seeding/seed.hpp"
#include "workflows/stages/cross_checks.hpp"

#include <cmath>

namespace flowslide {
namespace {

// Cells over the height of the soil that counts (docs/guide/checks.md).
constexpr double kFewestCells = 4.0;
constexpr double kFewCells = 12.0;

// What a point takes at most while it is run in three dimensions: its fields twice, its nodes.
constexpr double kBytesPerSeededPoint3d = 1500.0;

}  // namespace

void check_cells(const FlowConfig& flow, const Soil& soil, Findings& found) {
  if (soil.counted.empty()) return;
  const double height = soil.counted.height(), cells = height / flow.cell;
  if (cells < kFewestCells * (1.0 - 1e-6))
    found.errors.push_back(fmt::format(
        "cell: {:g} m are {:.2g} cells over the height of the soil of {:g} m (it cannot fail "
        "between so few nodes, and the runout would be 0 or meaningless) take at most {:.3g} m",
        flow.cell, cells, height, height / kFewestCells));
  else if (cells < kFewCells * (1.0 - 1e-6))
    found.warnings.push_back(fmt::format(
        "cell: {:g} m are {:.2g} cells over the height of the soil of {:g} m. So coarse a grid "
        "gives a runout that is too short, by half with 6 cells{}; take {:.3g} m or less for "
        "numbers to be used.",
        flow.cell, cells, height,
        flow.basis == mpm::BasisKind::mls ? ", and with basis mls by more than with quadratic" : "",
        height / 24.0));
}

void compare_cells(const FlowConfig& flow, const MapConfig& map, Findings& found) {
  if (map.seeding == Seeding::gauss) return;
  const double points = map.points_per_cell * flow.cell / map.cell;
  if (points < 1.0 - 1e-9) {
    found.errors.push_back(fmt::format(
        "cell: {:g} m against {:g} m in transfer.map leaves {:.2g} points per cell and direction "
        "(between points so far apart there is no soil) write the same cell for both, as in "
        "'cell: \"${{stages.flow.with.cell}}\"'",
        flow.cell, map.cell, points));
    return;
  }
  if (std::abs(flow.cell / map.cell - 1.0) > 1e-9) {
    found.warnings.push_back(fmt::format(
        "cell: {:g} m is not the {:g} m of transfer.map: its points were placed for other cells, "
        "{:.3g} of them per cell and direction in place of {}.",
        flow.cell, map.cell, points, map.points_per_cell));
    return;
  }
  for (int d = 0; d < 2; ++d) {
    const double shift = (flow.grid_origin[d] - map.grid_origin[d]) / flow.cell;
    if (std::abs(shift - std::round(shift)) > 1e-6) {
      found.warnings.push_back(fmt::format(
          "grid_origin: ({:g}, {:g}) m is not on the grid for which transfer.map placed the "
          "points, "
          "({:g}, {:g}) m.",
          flow.grid_origin[0], flow.grid_origin[1], map.grid_origin[0], map.grid_origin[1]));
      return;
    }
  }
}

void check_points(const FlowConfig& flow, const MapConfig& map, const Soil& soil, Findings& found) {
  constexpr double kFew = 2.0, kMany = 4.0;  // per cell and direction
  const bool gauss = map.seeding == Seeding::gauss;
  if (gauss && !(soil.largest > 0.0)) return;
  const double points =
      map.points_per_cell * flow.cell / (gauss ? std::sqrt(soil.largest) : map.cell);
  const char* where = gauss ? " in the largest elements" : "";
  if (points < 1.0 - 1e-9) {
    if (gauss)
      refuse(found,
             "seeding: gauss leaves {:.2g} points per cell of {:g} m and direction in elements of "
             "{:.3g} m2 (between points so far apart there is no soil) take lattice, larger cells "
             "or more points",
             points, flow.cell, soil.largest);
  } else if (points < kFew * (1.0 - 1e-6)) {
    warn(found,
         "points_per_cell: {:.2g} per cell and direction{} are too few: soil that stretches tears "
         "into pieces. Take 2.",
         points, where);
  } else if (points > kMany * (1.0 + 1e-6) && !gauss) {
    warn(found,
         "points_per_cell: {:.2g} per cell and direction take {:.3g} times as long as 2. "
         "Smaller cells make better use of them.",
         points, 0.25 * points * points);
  }
}

void check_memory(const MapConfig& map, const Soil& soil, double width, double memory,
                  Findings& found) {
  if (map.seeding == Seeding::gauss) return;
  const double per_metre = map.points_per_cell / map.cell;
  const bool plane = std::isnan(width);
  const double points = soil.area * per_metre * per_metre * (plane ? 1.0 : width * per_metre);
  const double bytes = points * (plane ? kBytesPerSeededPoint : kBytesPerSeededPoint3d);
  if (bytes > memory)
    found.errors.push_back(fmt::format(
        "cell: {:g} m makes about {:.2g} points, which take about {:.2g} GB (this machine has "
        "{:.2g} GB) use larger cells or fewer points per cell",
        map.cell, points, bytes / 1e9, memory / 1e9));
}

}  // namespace flowslide
