#include "fem/solver.hpp"

#include <algorithm>
#include <cmath>

namespace flowslide::fem {
namespace {

constexpr double kLargestStrainStep = 0.2;  ///< beyond it small-strain increments mean nothing

std::int32_t chunks(std::size_t n) { return static_cast<std::int32_t>((n + kChunk - 1) / kChunk); }

/// Velocities to strain increments and hourglass displacements; returns the largest increment.
void deform(Solver& s, std::int32_t begin, std::int32_t end, double& largest) {
  const Elements& g = s.layout.elements;
  const double* v = s.state.velocity.data();
  const double dt = s.dt;
  for (std::int32_t e = begin; e < end; ++e) {
    const std::array<std::int32_t, 8>& u = s.layout.dofs[e];
    double xx = 0, yy = 0, xy = 0, hx = 0, hy = 0;
    for (int i = 0; i < 4; ++i) {
      const double vx = v[u[2 * i]], vy = v[u[2 * i + 1]];
      xx += g.bx[i][e] * vx;
      yy += g.by[i][e] * vy;
      xy += g.by[i][e] * vx + g.bx[i][e] * vy;
      hx += g.gamma[i][e] * vx;
      hy += g.gamma[i][e] * vy;
    }
    double* de = &s.strain[3 * e];
    de[0] = dt * xx;
    de[1] = dt * yy;
    de[2] = dt * xy;
    s.state.hourglass_x[e] += dt * hx;
    s.state.hourglass_y[e] += dt * hy;
    largest = std::max({largest, std::abs(de[0]), std::abs(de[1]), std::abs(de[2])});
  }
}

void update_stress(Solver& s, std::int32_t e, Counters& counters) {
  const double* d = &s.strain[3 * e];
  const StrainIncrement<2> de{{d[0], d[1], 0.0, d[2]}};
  Stress<2>& stress = s.state.stress[e];
  const std::int32_t m = s.layout.material[e];
  const auto& begin = s.layout.law_begin;
  const auto element = static_cast<std::size_t>(e);
  if (element < begin[1]) {
    PM4Sand::State& state = s.state.pm4sand[e];
    const PM4Sand::Update r = PM4Sand::update(s.laws.pm4sand[m], state, stress, de);
    stress = r.stress;
    state = r.state;
    counters.sub_steps += r.sub_steps;
    counters.rejected += r.rejected;
    counters.floored += r.floored;
  } else if (element < begin[2]) {
    MohrCoulomb::State& state = s.state.mohr_coulomb[element - begin[1]];
    const auto r = MohrCoulomb::update(s.laws.mohr_coulomb[m], state, stress, de);
    stress = r.stress;
    state = r.state;
  } else {
    stress = hooke(s.laws.linear_elastic[m].elastic, stress, de);
  }
}

/// Takes back hourglass displacement beyond the strength of the soil.
void yield_hourglass(Solver& s, std::int32_t e) {
  const Stress<2>& stress = s.state.stress[e];
  const auto [cohesion, friction] = s.hourglass_strength[s.layout.material[e]];
  const double p = std::max(0.0, -0.5 * (stress[0] + stress[1]));
  const double limit = std::max(cohesion + friction * p, s.hourglass_rest[e]);
  const double present = hourglass_stress(s, e);
  if (!(present > limit)) return;
  s.state.hourglass_x[e] *= limit / present;
  s.state.hourglass_y[e] *= limit / present;
}

/// Water that the elements press to their nodes: volume change and Darcy flow.
void flow(Solver& s, std::int32_t begin, std::int32_t end) {
  const Elements& g = s.layout.elements;
  const double unit_weight = s.model.fluid.density * s.model.gravity;
  const double* p = s.state.pressure.data();
  for (std::int32_t e = begin; e < end; ++e) {
    if (!s.layout.saturated[e]) continue;
    const std::array<std::int32_t, 4>& nodes = s.layout.nodes[e];
    double gx = 0.0, gy = unit_weight;
    for (int i = 0; i < 4; ++i) {
      gx += g.bx[i][e] * p[nodes[i]];
      gy += g.by[i][e] * p[nodes[i]];
    }
    gx *= s.water.mobility_x[e];
    gy *= s.water.mobility_y[e];
    const double squeezed = 0.25 * (s.strain[3 * e] + s.strain[3 * e + 1]) / s.dt;
    for (int i = 0; i < 4; ++i)
      s.entry_flow[4 * e + i] = -g.volume[e] * (squeezed + g.bx[i][e] * gx + g.by[i][e] * gy);
  }
}

/// Internal forces of stress, pore pressure, hourglass and stiffness damping; with them the work
/// of the step, by the mean of the forces before and after.
void internal_forces(Solver& s, std::int32_t begin, std::int32_t end, Solver::ChunkSums& sums) {
  const Elements& g = s.layout.elements;
  const double* p = s.state.pressure.data();
  const double* v = s.state.velocity.data();
  const double beta = s.damping.stiffness, rate = beta / s.dt;
  double work = 0.0, lost = 0.0;
  for (std::int32_t e = begin; e < end; ++e) {
    const std::array<std::int32_t, 4>& nodes = s.layout.nodes[e];
    const std::array<std::int32_t, 8>& dofs = s.layout.dofs[e];
    const double* de = &s.strain[3 * e];
    const double u = s.layout.saturated[e]
                         ? 0.25 * (p[nodes[0]] + p[nodes[1]] + p[nodes[2]] + p[nodes[3]])
                         : 0.0;
    const double volumetric = s.lambda[e] * (de[0] + de[1]);
    const double vxx = rate * (volumetric + 2.0 * s.shear[e] * de[0]);
    const double vyy = rate * (volumetric + 2.0 * s.shear[e] * de[1]);
    const double vxy = rate * s.shear[e] * de[2];
    const Stress<2>& effective = s.state.stress[e];
    const double V = g.volume[e];
    const double sxx = V * (effective[0] - u + vxx), syy = V * (effective[1] - u + vyy);
    const double sxy = V * (effective[3] + vxy);

    std::array<double, 4> vx, vy;
    double hx = 0.0, hy = 0.0;
    for (int i = 0; i < 4; ++i) {
      vx[i] = v[dofs[2 * i]];
      vy[i] = v[dofs[2 * i + 1]];
      hx += g.gamma[i][e] * vx[i];
      hy += g.gamma[i][e] * vy[i];
    }
    const double G = s.hourglass_shear[e];
    const double qx = s.state.hourglass_x[e] + beta * hx;
    const double qy = s.state.hourglass_y[e] + beta * hy;
    const double fx = G * (g.hss[e] * qx - g.hst[e] * qy);
    const double fy = G * (g.htt[e] * qy - g.hst[e] * qx);
    double* f = &s.entry_force[8 * e];
    double power = 0.0;
    for (int i = 0; i < 4; ++i) {
      const double x = g.bx[i][e] * sxx + g.by[i][e] * sxy + g.gamma[i][e] * fx;
      const double y = g.by[i][e] * syy + g.bx[i][e] * sxy + g.gamma[i][e] * fy;
      power += (f[2 * i] + x) * vx[i] + (f[2 * i + 1] + y) * vy[i];
      f[2 * i] = x;
      f[2 * i + 1] = y;
    }
    work += 0.5 * s.dt * power;
    lost += V * (vxx * de[0] + vyy * de[1] + vxy * de[2]) +
            s.dt * beta * G * (g.hss[e] * hx * hx - 2.0 * g.hst[e] * hx * hy + g.htt[e] * hy * hy);
  }
  sums.deformation = work;
  sums.viscous = lost;
}

/// New velocities and displacements. Dashpots act on the mean of the velocities before and after,
/// which keeps them stable at any step.
Solver::UnknownSums move(Solver& s, std::int32_t begin, std::int32_t end, const BaseMotion& base) {
  Solver::UnknownSums sums;
  const Layout& l = s.layout;
  State& t = s.state;
  const double dt = s.dt, mid = 0.5 * (s.dt + t.last_dt);
  for (std::int32_t u = begin; u < end; ++u) {
    const double before = t.velocity[u];
    const double weight = l.weight[u] + s.model.load[u];
    const double c = s.dashpot[u], m = l.mass[u];
    const double internal = l.forces.sum(u, s.entry_force.data());
    double drive = s.base_drive[u] * base.start, after = base.end;
    if (s.prescribed[u])
      drive = m * (after - before) / mid + 0.5 * c * (before + after) + internal - weight;
    else
      after =
          ((m - 0.5 * mid * c) * before + mid * (weight + drive - internal)) / (m + 0.5 * mid * c);
    t.velocity[u] = after;
    t.displacement[u] += dt * after;
    const double lost = 0.5 * c * (before + after);
    sums.kinetic += 0.5 * m * before * after;
    sums.before.damping += lost * before;
    sums.after.damping += lost * after;
    sums.before.weight += weight * before;
    sums.after.weight += weight * after;
    sums.before.base += drive * before;
    sums.after.base += drive * after;
  }
  return sums;
}

std::int32_t largest_deformation(const Solver& s, std::int32_t begin, std::int32_t end) {
  const auto size = [&](std::int32_t e) {
    const double* de = &s.strain[3 * e];
    return std::max({std::abs(de[0]), std::abs(de[1]), std::abs(de[2])});
  };
  for (std::int32_t e = begin; e < end; ++e)
    if (!(size(e) <= kLargestStrainStep)) return e;
  return begin;
}

[[noreturn]] void report_failure(const Solver& s, std::int32_t element) {
  const std::int64_t tag = s.model.mesh.element_tags[s.layout.order[element]];
  const double* de = &s.strain[3 * element];
  throw NumericsError(fmt::format(
      "element {} fails at {:.5f} s, step {}: strain increments {:.3g} {:.3g} {:.3g} in {:.3g} s, "
      "stress {:.4g} {:.4g} {:.4g} Pa (the motion has run away there) look at the frames before; "
      "soil without strength or water without a way out are the usual causes",
      tag, s.state.time, s.state.step, de[0], de[1], de[2], s.dt, s.state.stress[element][0],
      s.state.stress[element][1], s.state.stress[element][3]));
}

/// Work is integrated by the trapezoidal rule: half of each step with the forces at its start, half
/// with those at its end, which the next call of `move` knows.
void add_energy(Solver& s) {
  Energy& energy = s.state.energy;
  Power before, after;
  energy.kinetic = 0.0;
  for (const Solver::UnknownSums& c : s.unknown_sums) {
    energy.kinetic += c.kinetic;
    before += c.before;
    after += c.after;
  }
  const double half = 0.5 * s.state.last_dt;
  Power& pending = s.state.pending;
  energy.damping += pending.damping + half * before.damping;
  energy.weight += pending.weight + half * before.weight;
  energy.base += pending.base + half * before.base;
  energy.deformation += s.state.pending_deformation;
  energy.viscous += s.state.pending_viscous;
  pending = {0.5 * s.dt * after.damping, 0.5 * s.dt * after.weight, 0.5 * s.dt * after.base};
}

}  // namespace

void start_motion(Solver& s) {
  std::fill(s.strain.begin(), s.strain.end(), 0.0);
  if (!is_set(s.dt)) s.dt = 1.0;
  Solver::ChunkSums unused;
  internal_forces(s, 0, static_cast<std::int32_t>(s.layout.elements.size()), unused);
}

void advance(Solver& s, const BaseMotion& base) {
  const auto elements = static_cast<std::int32_t>(s.layout.elements.size());
  const std::int32_t element_chunks = chunks(elements), unknown_chunks = chunks(s.model.num_dofs);
  const auto end_of = [](std::int32_t c, std::int32_t n) { return std::min(n, (c + 1) * kChunk); };
  if (s.water.factor_dt != s.dt) factorise(s.water, s.layout, s.dt);
  if (s.state.step == 0) s.state.last_dt = s.dt;
#pragma omp parallel
  {
#pragma omp for schedule(static)
    for (std::int32_t c = 0; c < unknown_chunks; ++c)
      s.unknown_sums[c] = move(s, c * kChunk, end_of(c, s.model.num_dofs), base);
#pragma omp for schedule(dynamic, 1)
    for (std::int32_t c = 0; c < element_chunks; ++c) {
      Solver::ChunkSums sums;
      const std::int32_t begin = c * kChunk, end = end_of(c, elements);
      deform(s, begin, end, sums.largest_strain);
      for (std::int32_t e = begin; e < end; ++e) {
        update_stress(s, e, sums.counters);
        if (!s.hourglass_strength.empty()) yield_hourglass(s, e);
        const Stress<2>& stress = s.state.stress[e];
        if (!std::isfinite(stress[0] + stress[1] + stress[3]) && sums.failed < 0) sums.failed = e;
      }
      flow(s, begin, end);
      s.element_sums[c] = sums;
    }
#pragma omp for schedule(static)
    for (std::int32_t q = 0; q < s.water.num_equations; ++q)
      s.pressure_rate[q] = s.water.flow.sum(q, s.entry_flow.data());
#pragma omp single
    if (s.water.num_equations > 0) {
      s.water.factor.solve(s.pressure_rate.data());
      for (std::size_t i = 0; i < s.state.pressure.size(); ++i) {
        const std::int32_t q = s.water.equation[i];
        if (q < s.water.num_equations) s.state.pressure[i] += s.dt * s.pressure_rate[q];
      }
    }
#pragma omp for schedule(static)
    for (std::int32_t c = 0; c < element_chunks; ++c)
      internal_forces(s, c * kChunk, end_of(c, elements), s.element_sums[c]);
  }
  add_energy(s);
  s.state.pending_deformation = s.state.pending_viscous = 0.0;
  for (std::int32_t c = 0; c < element_chunks; ++c) {
    const Solver::ChunkSums& sums = s.element_sums[c];
    s.state.pending_deformation += sums.deformation;
    s.state.pending_viscous += sums.viscous;
    s.counters.sub_steps += sums.counters.sub_steps;
    s.counters.rejected += sums.counters.rejected;
    s.counters.floored += sums.counters.floored;
    if (sums.failed >= 0) report_failure(s, sums.failed);
    if (!(sums.largest_strain <= kLargestStrainStep))
      report_failure(s, largest_deformation(s, c * kChunk, end_of(c, elements)));
  }
  s.state.last_dt = s.dt;
  s.state.time += s.dt;
  ++s.state.step;
}

}  // namespace flowslide::fem
