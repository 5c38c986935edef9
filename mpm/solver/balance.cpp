#include "mpm/solver/balance.hpp"

#include <algorithm>
#include <cmath>
#include <span>

namespace flowslide::mpm {

/// D of a point per direction [cells^2], with which its affine field carries energy.
template <int Dim>
std::array<double, Dim> affine_moments(const Simulation<Dim>& s, const Points<Dim>& points,
                                       std::size_t q) {
  return visit_basis(s.settings.basis, [&]<class Basis>(Basis) {
    std::array<double, Dim> moment;
    for (int d = 0; d < Dim; ++d) {
      double w[Basis::nodes], g[Basis::nodes];
      const double x = (points.x[d][q] - s.grid.origin[d]) / s.grid.h;
      const double in_support = x - base_node<Basis>(x);
      Basis::evaluate(in_support, w, g);
      moment[d] = second_moment<Basis>(in_support, w);
    }
    return moment;
  });
}

template <int Dim>
PointSums<Dim> sum_points(const Simulation<Dim>& s, const Points<Dim>& p) {
  const double h2 = s.grid.h * s.grid.h;
  PointSums<Dim> r;
  for (std::size_t q = 0; q < p.size(); ++q) {
    double v2 = 0.0, affine2 = 0.0, lift = 0.0;
    const std::array<double, Dim> moment = affine_moments(s, p, q);
    for (int d = 0; d < Dim; ++d) {
      v2 += p.v[d][q] * p.v[d][q];
      lift -= s.gravity[d] * p.x[d][q];
      r.momentum[d] += p.mass[q] * p.v[d][q];
    }
    for (int i = 0; i < Dim * Dim; ++i) affine2 += h2 * moment[i % Dim] * p.c[i][q] * p.c[i][q];
    Stress<Dim> sigma;
    for (int k = 0; k < kVoigt<Dim>; ++k) sigma[k] = p.sigma[k][q];
    const Elasticity& e = s.materials[p.material[q]].elastic;
    const double mean = mean_stress(sigma);
    const double stored =
        p.volume[q] * (mean * mean / (2.0 * e.bulk) + j2(sigma) / (2.0 * e.shear));
    r.mass += p.mass[q];
    r.kinetic += 0.5 * p.mass[q] * (v2 + affine2);
    r.potential += p.mass[q] * lift;
    r.recoverable += stored;
    if (!std::isfinite(v2 + affine2 + lift + stored) && r.finite) {
      r.finite = false;
      r.first_bad = p.index[q];
    }
  }
  return r;
}

namespace {

/// Fronts, runout and height of what counts, with what left where it did.
template <int Dim>
void measure_extent(const Simulation<Dim>& s, double toe, const std::vector<bool>& counts,
                    std::vector<Place>& scratch, MpmSample& r) {
  const auto along = [&](int axis) -> std::span<Place> {
    scratch.clear();
    for (const Points<Dim>* p : {&s.points, &s.gone})
      for (std::size_t q = 0; q < p->size(); ++q)
        if (counts[p->material[q]]) scratch.push_back({p->x[axis][q], p->mass[q]});
    return scratch;
  };
  const Fronts f = fronts(along(0));
  if (scratch.empty()) return;
  r.front = f.fifth;
  r.runout = std::max(0.0, r.front - toe);
  r.front_equal_mass = f.equal_mass;
  r.front_995 = f.q995;
  r.front_99 = f.q99;
  r.front_95 = f.q95;
  r.height = height(along(Dim - 1));
}

/// Where the energy has gone; docs/theory/mpm.md, section Balances.
template <int Dim>
void balance_energy(const Balance<Dim>& b, const PointSums<Dim>& start, const PointSums<Dim>& now,
                    const PointSums<Dim>& left, MpmSample& r) {
  const double stress_power = 0.5 * (b.power_start + b.power_end);
  const double kinetic_gain = now.kinetic + left.kinetic - start.kinetic;
  r.kinetic = now.kinetic;
  r.gravity_work = start.potential - now.potential - left.potential;
  r.strain_energy = now.recoverable + left.recoverable - start.recoverable;
  r.plastic_work = stress_power - r.strain_energy;
  r.friction_work = -b.grid.boundary;
  // Dissipation of the velocity transfer: what the grid gained and the points did not keep, at
  // time-centred velocities.
  const double grid_gain = 0.5 * (b.grid.internal_start + b.grid.internal_end) + b.grid.gravity +
                           b.grid.load + b.grid.damping + b.grid.boundary;
  const double transfer_loss =
      grid_gain - kinetic_gain - 0.5 * (b.grid.internal_start + b.power_end);
  r.damping_work = transfer_loss - b.grid.damping;
  r.load_work = b.grid.load;
  const double residual = r.gravity_work + r.load_work - kinetic_gain - r.strain_energy -
                          r.plastic_work - r.friction_work - r.damping_work;
  const double scale = std::max(
      {std::abs(r.gravity_work), std::abs(r.load_work), std::abs(stress_power), now.kinetic});
  r.energy_error = scale > 0.0 ? residual / scale : 0.0;
}

template <int Dim>
double momentum_error(const Balance<Dim>& b, const PointSums<Dim>& start, const PointSums<Dim>& now,
                      const PointSums<Dim>& left) {
  double impulse = 0.0, momentum_residual = 0.0;
  for (int d = 0; d < Dim; ++d) {
    const double expected = start.momentum[d] + b.grid.gravity_impulse[d] + b.grid.load_impulse[d] +
                            b.grid.boundary_impulse[d];
    momentum_residual =
        std::max(momentum_residual, std::abs(now.momentum[d] + left.momentum[d] - expected));
    impulse =
        std::max({impulse, std::abs(b.grid.gravity_impulse[d]), std::abs(b.grid.load_impulse[d])});
  }
  return impulse > 0.0 ? momentum_residual / impulse : 0.0;
}

}  // namespace

template <int Dim>
MpmSample sample(const Simulation<Dim>& s, const Reference<Dim>& reference,
                 const std::vector<bool>& counts, std::vector<Place>& scratch) {
  const PointSums<Dim> now = sum_points(s), left = sum_points(s, s.gone);
  const PointSums<Dim>& start = reference.start;
  if (!now.finite) {
    throw NumericsError(
        fmt::format("step {}, t = {:.4f} s: particle {} is no longer finite (the state cannot be "
                    "continued) try a "
                    "smaller courant, or check the stiffness and strength of its material",
                    s.step, s.time, now.first_bad));
  }
  MpmSample r;
  r.time = s.time;
  measure_extent(s, reference.toe, counts, scratch, r);
  balance_energy(s.balance, start, now, left, r);
  r.momentum_error = momentum_error(s.balance, start, now, left);
  r.mass_error = std::abs(now.mass + left.mass - start.mass) / start.mass;
  r.max_speed = std::sqrt(s.last.max_speed2);
  r.dt = s.dt;
  r.active_particles =
      s.sleep.count > 0 ? 1.0 - double(s.sleep.count) / double(s.points.size()) : 1.0;
  r.points_left = static_cast<double>(s.gone.size());
  r.mass_left = left.mass;
  r.kinetic_left = left.kinetic;
  r.strain_energy_left = left.recoverable;
  r.momentum_left_x = left.momentum.front();
  r.momentum_left_y = left.momentum.back();
  return r;
}

template PointSums<2> sum_points<2>(const Simulation<2>&, const Points<2>&);
template PointSums<3> sum_points<3>(const Simulation<3>&, const Points<3>&);
template MpmSample sample<2>(const Simulation<2>&, const Reference<2>&, const std::vector<bool>&,
                             std::vector<Place>&);
template MpmSample sample<3>(const Simulation<3>&, const Reference<3>&, const std::vector<bool>&,
                             std::vector<Place>&);

}  // namespace flowslide::mpm
