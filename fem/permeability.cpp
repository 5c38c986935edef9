#include "fem/permeability.hpp"

#include "core/elementary.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace flowslide::fem {
namespace {

bool rises(const Material& m) { return m.permeability_rise.factor != 1.0; }

bool follows(const Solver& s, std::size_t e) {
  return s.layout.saturated[e] && s.rest_weight[e] > 0.0 &&
         rises(s.model.materials[s.layout.material[e]]);
}

}  // namespace

double permeability_factor(const PermeabilityRise& rise, double r_u) {
  if (!(r_u > 0.0)) return 1.0;
  return 1.0 + (rise.factor - 1.0) * pow(std::min(r_u, 1.0), rise.exponent);
}

void let_permeability_rise(Solver& s) {
  if (!std::ranges::any_of(s.model.materials, rises)) return;
  const std::size_t n = s.layout.elements.size();
  s.rest_pressure.resize(n);
  s.rest_weight.resize(n);
  for (std::size_t e = 0; e < n; ++e) {
    s.rest_pressure[e] = mean_pressure(s, e);
    s.rest_weight[e] = -s.state.stress[e][1];
  }
}

void refresh_permeability(Solver& s) {
  if (s.rest_pressure.empty()) return;
  const double unit_weight = s.model.fluid.density * s.model.gravity;
  const auto mobility = [&](std::size_t e) {
    const Material& m = s.model.materials[s.layout.material[e]];
    const double r_u = (mean_pressure(s, e) - s.rest_pressure[e]) / s.rest_weight[e];
    const double each = permeability_factor(m.permeability_rise, r_u) / unit_weight;
    return std::pair(each * m.permeability[0], each * m.permeability[1]);
  };
  const auto far = [](double now, double used) {
    return std::abs(now - used) > kPermeabilityChange * used;
  };
  bool changed = false;
  for (std::size_t e = 0; e < s.rest_pressure.size() && !changed; ++e) {
    if (!follows(s, e)) continue;
    const auto [x, y] = mobility(e);
    changed = far(x, s.water.mobility_x[e]) || far(y, s.water.mobility_y[e]);
  }
  if (!changed) return;
  for (std::size_t e = 0; e < s.rest_pressure.size(); ++e)
    if (follows(s, e)) std::tie(s.water.mobility_x[e], s.water.mobility_y[e]) = mobility(e);
  s.water.factor_dt = kUnset;  // the matrix of the water holds them
}

}  // namespace flowslide::fem
