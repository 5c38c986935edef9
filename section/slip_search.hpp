#pragma once
#include "section/limit_equilibrium.hpp"

#include <array>
#include <vector>

/// Searches for the slip surface of the smallest factor of safety. The same model gives the same
/// surface: grids and pattern searches, no random numbers.
namespace flowslide {

struct SlipSearch {
  std::array<double, 2> entry{};  ///< range of x where the surface may start, on the high side [m]
  std::array<double, 2> exit{};   ///< range of x where it may end [m]
  double floor = 0.0;             ///< no surface below this y [m]
  double slice_width = 1.0;       ///< at most [m]
  int points = 6;                 ///< of surfaces that are not circles, with both ends
};

struct CriticalCircle {
  double factor = 0.0;
  Vec2 centre{};
  double radius = 0.0;
  std::vector<Vec2> surface;
};
/// Over entry, exit and depth of the arc, with bishop(). Throws NumericsError if no circle is
/// admissible.
CriticalCircle search_circles(const SlopeModel& model, const SlipSearch& search);

struct CriticalSurface {
  double factor = 0.0;
  double inclination = 0.0;  ///< of the forces between slices [rad]
  std::vector<Vec2> surface;
};
/// Over lines that bend upwards only, with spencer(); starts from the critical circle and from
/// surfaces of three legs with a level middle, of which `levels` gives heights to try besides a
/// regular set. Throws NumericsError if none is admissible.
CriticalSurface search_surfaces(const SlopeModel& model, const SlipSearch& search,
                                const std::vector<double>& levels = {});

}  // namespace flowslide
