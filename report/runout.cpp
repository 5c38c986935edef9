#include "report/runout.hpp"

#include "core/check.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace flowslide {
namespace {

void check_arrays(std::span<const std::array<double, 3>> positions,
                  std::span<const std::uint8_t> counts) {
  validate(positions.size() == counts.size(),
           "{} positions but {} flags (every point needs one flag) give arrays of equal length",
           positions.size(), counts.size());
  for (std::size_t i = 0; i < positions.size(); ++i)
    validate(!counts[i] || std::isfinite(positions[i][0]),
             "position of point {} is not finite (the front cannot be found) look for the step in "
             "which the run became unstable",
             i);
}

}  // namespace

double front_position(std::span<const std::array<double, 3>> positions,
                      std::span<const std::uint8_t> counts) {
  check_arrays(positions, counts);
  std::vector<Place> points;
  for (std::size_t i = 0; i < positions.size(); ++i)
    if (counts[i]) points.push_back({positions[i][0], 1.0});
  validate(points.size() >= kFrontRank,
           "{} material points count for the runout (the front is the fifth-farthest one) refine "
           "the points, or set counts_for_runout on the materials that flow",
           points.size());
  return fronts(points).fifth;
}

double runout(std::span<const std::array<double, 3>> positions,
              std::span<const std::uint8_t> counts, double toe) {
  validate(std::isfinite(toe), "the toe is not set (runout is measured from it) give its x");
  return std::max(0.0, front_position(positions, counts) - toe);
}

double front_quantile(std::span<const std::array<double, 3>> positions,
                      std::span<const std::uint8_t> counts, std::span<const double> mass,
                      double share) {
  check_arrays(positions, counts);
  validate(mass.size() == counts.size(),
           "{} masses for {} points (every point needs one) give arrays of equal length",
           mass.size(), counts.size());
  validate(share >= 0.0 && share < 1.0,
           "mass share {} (the quantile is defined from 0 to 1) give a value such as 0.005", share);
  std::vector<Place> points;
  for (std::size_t i = 0; i < positions.size(); ++i) {
    if (!counts[i]) continue;
    validate(mass[i] > 0.0, "mass of point {} is {} kg (it must be positive)", i, mass[i]);
    points.push_back({positions[i][0], mass[i]});
  }
  validate(!points.empty(), "no material point counts (there is no front) check the materials");
  double front = 0.0;
  places_beyond(points, {&share, 1}, {&front, 1});
  return front;
}

}  // namespace flowslide
