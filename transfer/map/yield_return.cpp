#include "transfer/map/yield_return.hpp"

#include "constitutive/principal.hpp"
#include "core/elementary.hpp"

#include <algorithm>
#include <cmath>

namespace flowslide {

double relative_violation(const MohrCoulombSurface<double>& surface, const Stress<2>& stress) {
  const double centre = 0.5 * (stress[0] + stress[1]);
  const double radius = hypot(0.5 * (stress[0] - stress[1]), stress[3]);
  const Sorted3<double> s = sort3(centre + radius, centre - radius, stress[2]);
  const double unconfined = std::max(surface.sigma_c, 1.0);
  const double confined = std::max(surface.sigma_c - surface.k * s.hi, unconfined);
  return std::max((surface.k * s.hi - s.lo - surface.sigma_c) / confined,
                  (s.hi - surface.tension) / unconfined);
}

double relative_violation(double strength, double tension_cutoff, const Stress<2>& stress) {
  return std::max(std::sqrt(j2(stress)) - strength, mean_stress(stress) - tension_cutoff) /
         std::max(strength, 1.0);
}

Stress<2> return_mohr_coulomb(const MohrCoulomb::Constants& constants,
                              const MohrCoulomb::State& state, const Stress<2>& total) {
  // In effective stress: the transfer keeps u, while the law would let it fall where soil opens.
  Stress<2> effective = total;
  for (int i = 0; i < 3; ++i) effective[i] += state.pore_pressure;
  MohrCoulomb::State dry = state;
  dry.pore_pressure = 0.0;
  Stress<2> returned = MohrCoulomb::update<2>(constants, dry, effective, {}).stress;
  for (int i = 0; i < 3; ++i) returned[i] -= state.pore_pressure;
  return returned;
}

Stress<2> return_liquefied(LiquefiedReturn method, double strength, double tension_cutoff,
                           const Stress<2>& total) {
  if (method == LiquefiedReturn::none) return total;
  const double p = mean_stress(total);
  const double shear = std::sqrt(j2(total));
  double scale = shear > strength ? strength / shear : 1.0;
  double mean = std::min(p, tension_cutoff);
  if (method == LiquefiedReturn::vertical_stress) {
    const double s_yy = total[1] - p;
    mean = total[1] - scale * s_yy;
    if (mean > tension_cutoff) {
      // Less deviator keeps sigma_yy, unless sigma_yy itself is beyond the cut-off.
      scale = s_yy < 0.0 && total[1] < tension_cutoff ? (total[1] - tension_cutoff) / s_yy : 0.0;
      mean = std::min(total[1] - scale * s_yy, tension_cutoff);
    }
  }
  Stress<2> returned;
  for (int i = 0; i < 3; ++i) returned[i] = mean + scale * (total[i] - p);
  returned[3] = scale * total[3];
  return returned;
}

}  // namespace flowslide
