#include "fem/element_loops.hpp"
#include "fem/solver.hpp"

#include <algorithm>
#include <cmath>

namespace flowslide::fem {
namespace {

std::int32_t chunks(std::size_t n) { return static_cast<std::int32_t>((n + kChunk - 1) / kChunk); }

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
  StressQueue queue(s.layout);
#pragma omp parallel
  {
#pragma omp for schedule(static)
    for (std::int32_t c = 0; c < unknown_chunks; ++c)
      s.unknown_sums[c] = move(s, c * kChunk, end_of(c, s.model.num_dofs), base);
#pragma omp for schedule(static)
    for (std::int32_t c = 0; c < element_chunks; ++c) {
      Solver::ChunkSums sums;
      const std::int32_t begin = c * kChunk, end = end_of(c, elements);
      deform(s, begin, end, sums.largest_strain);
      flow(s, begin, end);
      s.element_sums[c] = sums;
    }
#pragma omp for schedule(static)
    for (std::int32_t q = 0; q < s.water.num_equations; ++q)
      s.pressure_rate[q] = s.water.flow.sum(q, s.entry_flow.data());
#pragma omp single nowait
    if (s.water.num_equations > 0) {
      s.water.factor.solve(s.pressure_rate.data());
      for (std::size_t i = 0; i < s.state.pressure.size(); ++i) {
        const std::int32_t q = s.water.equation[i];
        if (q < s.water.num_equations) s.state.pressure[i] += s.dt * s.pressure_rate[q];
      }
    }
    // beside the water, which does not hang on them
    update_stresses(s, queue);
#pragma omp barrier
#pragma omp for schedule(static)
    for (std::int32_t c = 0; c < element_chunks; ++c) {
      check_stresses(s, c * kChunk, end_of(c, elements), s.element_sums[c]);
      internal_forces(s, c * kChunk, end_of(c, elements), s.element_sums[c]);
    }
  }
  add_energy(s);
  s.state.pending_deformation = s.state.pending_viscous = 0.0;
  for (std::int32_t c = 0; c < element_chunks; ++c) {
    const Solver::ChunkSums& sums = s.element_sums[c];
    s.state.pending_deformation += sums.deformation;
    s.state.pending_viscous += sums.viscous;
    if (sums.failed >= 0) report_failure(s, sums.failed);
    if (!(sums.largest_strain <= kLargestStrainStep))
      report_failure(s, largest_deformation(s, c * kChunk, end_of(c, elements)));
  }
  s.state.last_dt = s.dt;
  s.state.time += s.dt;
  ++s.state.step;
}

}  // namespace flowslide::fem
