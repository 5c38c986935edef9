#include "fem/element_loops.hpp"

#include "constitutive/pm4sand_lanes.hpp"

#include <algorithm>
#include <cmath>

namespace flowslide::fem {

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

namespace {

/// The next elements of a law that no thread has taken, `block` of them at most; false at the end.
bool take(std::atomic<std::int32_t>& taken, std::size_t last, std::size_t block, std::size_t& begin,
          std::size_t& end) {
  begin = static_cast<std::size_t>(taken.fetch_add(static_cast<std::int32_t>(block)));
  end = std::min(last, begin + block);
  return begin < last;
}

StrainIncrement<2> strain_of(const Solver& s, std::size_t e) {
  const double* d = &s.strain[3 * e];
  return {{d[0], d[1], 0.0, d[2]}};
}

/// Elements of a law that integrates many points at a time.
template <class M>
requires requires { typename M::Task; }
Counters update_law(Solver& s, std::atomic<std::int32_t>& taken, std::size_t last) {
  std::size_t e = 0, end = 0;
  const auto next = [&](typename M::Task& task) {
    if (e == end && !take(taken, last, kPackLanes, e, end)) return false;
    task = {&constants_of<M>(s, s.layout.material[e]), &state_of<M>(s, e), &s.state.stress[e],
            strain_of(s, e)};
    ++e;
    return true;
  };
  const auto work = M::update_all(next);
  return {work.sub_steps, work.rejected, work.floored};
}

template <class M>
Counters update_law(Solver& s, std::atomic<std::int32_t>& taken, std::size_t last) {
  for (std::size_t e, end; take(taken, last, kChunk, e, end);)
    for (; e < end; ++e) {
      typename M::State& state = state_of<M>(s, e);
      const auto r = M::update(constants_of<M>(s, s.layout.material[e]), state, s.state.stress[e],
                               strain_of(s, e));
      s.state.stress[e] = r.stress;
      state = r.state;
    }
  return {};
}

/// Takes back hourglass displacement beyond the strength of the soil.
void yield_hourglass(Solver& s, std::size_t e) {
  const Stress<2>& stress = s.state.stress[e];
  const auto [cohesion, friction] = s.hourglass_strength[s.layout.material[e]];
  const double p = std::max(0.0, -0.5 * (stress[0] + stress[1]));
  const double limit = std::max(cohesion + friction * p, s.hourglass_rest[e]);
  const double present = hourglass_stress(s, e);
  if (!(present > limit)) return;
  s.state.hourglass_x[e] *= limit / present;
  s.state.hourglass_y[e] *= limit / present;
}

}  // namespace

StressQueue::StressQueue(const Layout& l) {
  for (std::size_t k = 0; k < taken.size(); ++k)
    taken[k] = static_cast<std::int32_t>(l.law_begin[k]);
}

void update_stresses(Solver& s, StressQueue& queue) {
  Counters sum;
  each_law(s.layout, 0, s.layout.elements.size(), [&]<class M>(std::size_t, std::size_t last) {
    const Counters c = update_law<M>(s, queue.taken[ShakingLaws::index<M>()], last);
    sum.sub_steps += c.sub_steps;
    sum.rejected += c.rejected;
    sum.floored += c.floored;
  });
#pragma omp atomic
  s.counters.sub_steps += sum.sub_steps;
#pragma omp atomic
  s.counters.rejected += sum.rejected;
#pragma omp atomic
  s.counters.floored += sum.floored;
}

void check_stresses(Solver& s, std::int32_t begin, std::int32_t end, Solver::ChunkSums& sums) {
  for (std::int32_t e = begin; e < end; ++e) {
    if (!s.hourglass_strength.empty()) yield_hourglass(s, e);
    const Stress<2>& stress = s.state.stress[e];
    if (!std::isfinite(stress[0] + stress[1] + stress[3]) && sums.failed < 0) sums.failed = e;
  }
}

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

void internal_forces(Solver& s, std::int32_t begin, std::int32_t end, Solver::ChunkSums& sums) {
  const Elements& g = s.layout.elements;
  const double* p = s.state.pressure.data();
  const double* v = s.state.velocity.data();
  double work = 0.0, lost = 0.0;
  for (std::int32_t e = begin; e < end; ++e) {
    const std::array<std::int32_t, 4>& nodes = s.layout.nodes[e];
    const std::array<std::int32_t, 8>& dofs = s.layout.dofs[e];
    const double* de = &s.strain[3 * e];
    const double u = s.layout.saturated[e]
                         ? 0.25 * (p[nodes[0]] + p[nodes[1]] + p[nodes[2]] + p[nodes[3]])
                         : 0.0;
    const double beta = s.stiffness_damping[e], rate = beta / s.dt;
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

}  // namespace flowslide::fem
