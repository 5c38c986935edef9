#pragma once
#include "core/conventions.hpp"
#include "mpm/run/flow_config.hpp"
#include "mpm/run/load.hpp"
#include "mpm/solver/balance.hpp"

#include <map>
#include <string>

/// Small scenes for verification: lattices of points, one thread, stepped by hand.
namespace flowslide::mpm {

struct Area {
  double x0, y0, x1, y1;  ///< [m]
};

/// Appends points at the centres of squares of side `spacing` that fill the area and for which
/// `inside(x, y)` holds; density in kg/m3.
template <class Inside>
void fill(ParticleSet& p, const Area& area, double spacing, double density, std::int32_t material,
          Inside&& inside);
void fill(ParticleSet& p, const Area& area, double spacing, double density,
          std::int32_t material = 0);

/// A material of one law with its parameters in SI.
MaterialSpec material(const std::string& law, std::map<std::string, double> parameters);
MaterialSpec elastic(double youngs_modulus, double poisson_ratio);

/// No gravity, the ground out of reach, no end.
FlowConfig free_space(double cell);

/// A running scene.
struct Trial {
  Simulation<2> sim;
  StepScratch<2> scratch{1};
  Reference<2> reference;

  Trial(const ParticleSet& particles, const FlowConfig& config);
  /// One step; throws NumericsError when velocities are no longer finite.
  void step();
  void run_to(double time);
  /// The time step that step() will take [s].
  [[nodiscard]] double next_dt() const;
  /// Damping in proportion to the mass: velocities fall with `rate` [1/s] over the last step. At
  /// rest it does nothing, so the state it leads to is that without it.
  void damp(double rate);
  /// Sorts the points anew: needed after they were moved by hand.
  void rebin();
  /// Balances since the start.
  [[nodiscard]] MpmSample balances() const;

  /// A body force given by its acceleration, `a(q)` of point q [m/s2], for the next step: the
  /// points take up its impulse before they go to the grid, which is sum_p w_ip m_p a there.
  template <class Acceleration>
  void accelerate(Acceleration&& a) {
    const double dt = next_dt();
    for (std::size_t q = 0; q < sim.points.size(); ++q) {
      const std::array<double, 2> gain = a(q);
      sim.points.v[0][q] += dt * gain[0];
      sim.points.v[1][q] += dt * gain[1];
    }
  }
};

/// Slope of log(error) over log(cell) by least squares.
double fitted_order(const std::vector<double>& cells, const std::vector<double>& errors);

template <class Inside>
void fill(ParticleSet& p, const Area& area, double spacing, double density, std::int32_t material,
          Inside&& inside) {
  const auto nx = static_cast<int>(std::lround((area.x1 - area.x0) / spacing));
  const auto ny = static_cast<int>(std::lround((area.y1 - area.y0) / spacing));
  for (int j = 0; j < ny; ++j) {
    for (int i = 0; i < nx; ++i) {
      const double x = area.x0 + (i + 0.5) * spacing, y = area.y0 + (j + 0.5) * spacing;
      if (!inside(x, y)) continue;
      const std::size_t q = p.size();
      resize(p, q + 1);
      p.position[q] = {x, y, 0.0};
      p.volume[q] = spacing * spacing;
      p.mass[q] = density * p.volume[q];
      p.material[q] = material;
      p.id[q] = static_cast<std::int64_t>(q) + 1;
    }
  }
}

}  // namespace flowslide::mpm
