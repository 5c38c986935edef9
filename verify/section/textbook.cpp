#include "core/conventions.hpp"
#include "core/elementary.hpp"
#include "section/slip_search.hpp"
#include "verify/section/list.hpp"

#include <cmath>

namespace flowslide::section {
namespace {

/// One soil under a straight slope that falls from (0, height) to (width, 0), with level ground.
SlopeModel straight_slope(const SlopeSoil& soil, double width, double height, double bottom) {
  SlopeModel m;
  const double left = -4.0 * height, right = width + 4.0 * height;
  m.soils = {soil};
  m.ground = {{left, height}, {0.0, height}, {width, 0.0}, {right, 0.0}};
  m.zones = {{0,
              {{left, bottom},
               {right, bottom},
               {right, 0.0},
               {width, 0.0},
               {0.0, height},
               {left, height}}}};
  return m;
}

}  // namespace

/// Figure 8 of the paper: 40 ft at 2 to 1, c' 600 psf, phi' 20 degrees, 120 pcf; the circle about a
/// point 30 ft above the crest and 20 ft upstream of the toe, radius 80 ft. Factors have no unit,
/// so feet and pounds stay. The paper does not say how many slices it used; half a per cent covers
/// what its numbers differ by between programs.
std::vector<Check> verify_fredlund_krahn(std::string_view name) {
  CheckList list(name);
  SlopeSoil soil{.name = "soil",
                 .unit_weight = 120.0,
                 .cohesion = 600.0,
                 .friction = 20.0 * kDegree,
                 .r_u = {},
                 .residual = {}};
  const auto slices_of = [&soil] {
    const SlopeModel m = straight_slope(soil, 80.0, 40.0, -40.0);
    const double left = 60.0 - std::sqrt(80.0 * 80.0 - 30.0 * 30.0);
    const double right = 60.0 + std::sqrt(80.0 * 80.0 - 70.0 * 70.0);
    return cut_slices(m, arc({60.0, 70.0}, 80.0, left, right, 200), 1.0);
  };
  std::vector<Slice> slices = slices_of();
  list.near("ordinary", ordinary(slices).value_or(kUnset), 1.928, 0.005 * 1.928);
  list.near("bishop", bishop(slices).value_or(kUnset), 2.080, 0.005 * 2.080);
  const auto dry = spencer(slices);
  list.near("spencer", dry ? dry->factor : kUnset, 2.073, 0.005 * 2.073);
  list.near("spencer_inclination", dry ? dry->inclination / kDegree : kUnset, 14.81, 0.5, "deg");
  soil.r_u = 0.25;
  slices = slices_of();
  list.near("ordinary_ru_0.25", ordinary(slices).value_or(kUnset), 1.607, 0.005 * 1.607);
  list.near("bishop_ru_0.25", bishop(slices).value_or(kUnset), 1.766, 0.005 * 1.766);
  const auto wet = spencer(slices);
  list.near("spencer_ru_0.25", wet ? wet->factor : kUnset, 1.761, 0.005 * 1.761);
  return list.take();
}

/// Taylor (1937): N = c / (F gamma H) of toe circles, phi = 0. His three digits are the tolerance.
std::vector<Check> verify_taylor(std::string_view name) {
  CheckList list(name);
  constexpr double kHeight = 10.0, kStrength = 20e3, kWeight = 20e3;
  const SlopeSoil clay{.name = "clay",
                       .unit_weight = kWeight,
                       .cohesion = kStrength,
                       .friction = 0.0,
                       .r_u = {},
                       .residual = {}};
  for (const auto& [angle, number] : {std::pair{60.0, 0.191}, {75.0, 0.219}, {90.0, 0.261}}) {
    // A vertical cut is given the width of 20 mm: the ground is a function of x here.
    const double width = angle == 90.0 ? 0.02 : kHeight / tan(angle * kDegree);
    const SlopeModel m = straight_slope(clay, width, kHeight, -30.0);
    const SlipSearch search{
        .entry = {-30.0, -0.5}, .exit = {width, width + 0.01}, .floor = -30.0, .slice_width = 0.25};
    list.near(fmt::format("number_{:.0f}_deg", angle),
              kStrength / (search_circles(m, search).factor * kWeight * kHeight), number, 1e-3);
  }
  return list.take();
}

/// Example 1 of Griffiths & Lane (1999): 2 to 1, phi' 20 degrees, c'/(gamma H) = 0.05, firm base at
/// the toe. Bishop & Morgenstern give 1.380; finite elements gave them 1.4.
std::vector<Check> verify_griffiths_lane(std::string_view name) {
  CheckList list(name);
  const SlopeSoil soil{.name = "soil",
                       .unit_weight = 20e3,
                       .cohesion = 10e3,
                       .friction = 20.0 * kDegree,
                       .r_u = {},
                       .residual = {}};
  const SlopeModel m = straight_slope(soil, 20.0, 10.0, -0.01);
  const SlipSearch search{
      .entry = {-11.0, 0.0}, .exit = {10.0, 20.0}, .floor = 0.0, .slice_width = 0.25};
  const CriticalCircle circle = search_circles(m, search);
  list.near("bishop", circle.factor, 1.380, 0.01);
  const auto s = spencer(cut_slices(m, circle.surface, search.slice_width));
  list.near("spencer", s ? s->factor : kUnset, 1.380, 0.01);
  return list.take();
}

}  // namespace flowslide::section
