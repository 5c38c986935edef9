#include "fem/implicit.hpp"

#include "core/elementary.hpp"
#include "fem/element_loops.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace flowslide::fem {
namespace {

constexpr int kDepth = 12;       ///< differences that the acceleration keeps
constexpr int kStepsToGrow = 8;  ///< steps that converge before a halved step is doubled

/// Weight of the nodes of the motion; for the water the volume that a pressure of rho g sqrt(A)
/// stores there.
std::vector<double> residual_scale(const Solver& s, const CoupledMatrix& m) {
  std::vector<double> scale(m.size(), 0.0);
  for (std::int32_t u = 0; u < s.model.num_dofs; ++u)
    if (m.row_of()[u] >= 0) scale[m.row_of()[u]] = s.layout.mass[u] * s.model.gravity;
  std::vector<double> pressure(s.water.num_equations + 1, 0.0);
  for (std::size_t e = 0; e < s.layout.elements.size(); ++e) {
    const double density = s.model.materials[s.layout.material[e]].density;
    for (const std::int32_t node : s.layout.nodes[e]) {
      double& p = pressure[s.water.equation[node]];
      p = std::max(p, density * s.model.gravity * std::sqrt(s.layout.elements.area[e]));
    }
  }
  const Eigen::VectorXd diagonal = m.storage().diagonal();
  for (std::int32_t q = 0; q < s.water.num_equations; ++q)
    scale[m.motions() + q] = diagonal[q] * pressure[q];
  return scale;
}

std::vector<std::int32_t> elements_at(const Solver& s, const CoupledMatrix& m) {
  std::vector<std::int32_t> r(m.size(), -1);
  for (std::size_t e = 0; e < s.layout.elements.size(); ++e) {
    for (const std::int32_t u : s.layout.dofs[e])
      if (m.row_of()[u] >= 0) r[m.row_of()[u]] = static_cast<std::int32_t>(e);
    for (const std::int32_t node : s.layout.nodes[e])
      if (const std::int32_t q = s.water.equation[node]; q < s.water.num_equations)
        r[m.motions() + q] = static_cast<std::int32_t>(e);
  }
  return r;
}

/// In the norm of energy: sqrt(mass) of velocities, sqrt(storage) of pressures.
Eigen::VectorXd energy_weights(const Solver& s, const CoupledMatrix& m) {
  Eigen::VectorXd w(m.size());
  for (std::int32_t u = 0; u < s.model.num_dofs; ++u)
    if (m.row_of()[u] >= 0) w[m.row_of()[u]] = std::sqrt(s.layout.mass[u]);
  w.tail(s.water.num_equations) = m.storage().diagonal().cwiseSqrt();
  return w;
}

void mix(std::vector<double>& to, const std::vector<double>& start, const std::vector<double>& end,
         double theta) {
  for (std::size_t i = 0; i < to.size(); ++i) to[i] = (1.0 - theta) * start[i] + theta * end[i];
}

}  // namespace

ImplicitSteps::ImplicitSteps(const Solver& s, const ImplicitSettings& settings)
    : settings_(settings),
      matrix_(s),
      scale_(residual_scale(s, matrix_)),
      element_at_(elements_at(s, matrix_)),
      anderson_(energy_weights(s, matrix_), kDepth),
      x_(matrix_.size()),
      residual_(matrix_.size()),
      change_(matrix_.size()),
      rate_(Eigen::VectorXd::Zero(s.water.num_equations)),
      middle_(s.model.num_dofs + 1, 0.0),
      internal_(s.model.num_dofs, 0.0) {}

/// Strains, stresses and flows of the velocities of the state over the step; false where the soil
/// deforms too much for small strains.
bool ImplicitSteps::follow_soil(Solver& s) {
  const auto elements = static_cast<std::int32_t>(s.layout.elements.size());
  const auto chunks = static_cast<std::int32_t>(s.element_sums.size());
  const auto end_of = [&](std::int32_t c) { return std::min(elements, (c + 1) * kChunk); };
  double largest = 0.0;
#pragma omp parallel for schedule(static) reduction(max : largest)
  for (std::int32_t c = 0; c < chunks; ++c) {
    s.element_sums[c] = {};
    deform(s, c * kChunk, end_of(c), s.element_sums[c].largest_strain);
    largest = std::max(largest, s.element_sums[c].largest_strain);
  }
  if (!(largest <= kLargestStrainStep)) return false;
  StressQueue queue(s.layout);
#pragma omp parallel
  {
    update_stresses(s, queue);
#pragma omp barrier
#pragma omp for schedule(static)
    for (std::int32_t c = 0; c < chunks; ++c) {
      check_stresses(s, c * kChunk, end_of(c), s.element_sums[c]);
      flow(s, c * kChunk, end_of(c));
    }
  }
  end_stress_ = s.state.stress;
  end_hourglass_x_ = s.state.hourglass_x;
  end_hourglass_y_ = s.state.hourglass_y;
  const double theta = settings_.theta;
  for (std::size_t e = 0; e < end_stress_.size(); ++e)
    for (int k = 0; k < 4; ++k)
      s.state.stress[e][k] = (1.0 - theta) * start_.stress[e][k] + theta * end_stress_[e][k];
  mix(s.state.hourglass_x, start_.hourglass_x, end_hourglass_x_, theta);
  mix(s.state.hourglass_y, start_.hourglass_y, end_hourglass_y_, theta);
#pragma omp parallel for schedule(static)
  for (std::int32_t c = 0; c < chunks; ++c)
    internal_forces(s, c * kChunk, end_of(c), s.element_sums[c]);
  bool finite = true;
  for (const Solver::ChunkSums& sums : s.element_sums) {
    finite = finite && sums.failed < 0;
  }
  return finite;
}

ImplicitSteps::Residual ImplicitSteps::evaluate(Solver& s, const Base& base) {
  State& t = s.state;
  const double theta = settings_.theta;
  t.stress = start_.stress;
  t.hourglass_x = start_.hourglass_x;
  t.hourglass_y = start_.hourglass_y;
  t.laws = start_.laws;
  for (std::int32_t u = 0; u < s.model.num_dofs; ++u) {
    const std::int32_t row = matrix_.row_of()[u];
    middle_[u] = (1.0 - theta) * start_.velocity[u] + theta * (row >= 0 ? x_[row] : base.end);
  }
  t.velocity = middle_;
  for (std::size_t i = 0; i < t.pressure.size(); ++i)
    if (const std::int32_t q = s.water.equation[i]; q < s.water.num_equations)
      t.pressure[i] = (1.0 - theta) * start_.pressure[i] + theta * x_[matrix_.motions() + q];
  if (!follow_soil(s)) return {std::numeric_limits<double>::infinity(), -1};

  for (std::size_t i = 0; i < t.pressure.size(); ++i)
    if (const std::int32_t q = s.water.equation[i]; q < s.water.num_equations)
      rate_[q] = (x_[matrix_.motions() + q] - start_.pressure[i]) / s.dt;
  residual_.tail(s.water.num_equations).noalias() = matrix_.storage() * rate_;
  for (std::int32_t q = 0; q < s.water.num_equations; ++q)
    residual_[matrix_.motions() + q] -= s.water.flow.sum(q, s.entry_flow.data());
  for (std::int32_t u = 0; u < s.model.num_dofs; ++u) {
    internal_[u] = s.layout.forces.sum(u, s.entry_force.data());
    if (const std::int32_t row = matrix_.row_of()[u]; row >= 0)
      residual_[row] = s.layout.mass[u] * (x_[row] - start_.velocity[u]) / s.dt +
                       s.dashpot[u] * middle_[u] + internal_[u] - s.layout.weight[u] -
                       s.model.load[u] - s.base_drive[u] * base.mean;
  }
  Residual r;
  for (std::int32_t row = 0; row < matrix_.size(); ++row) {
    const double flow_over = row < matrix_.motions() ? 1.0 : s.dt;
    const double size = std::abs(residual_[row]) * flow_over / (settings_.tolerance * scale_[row]);
    if (!(size <= r.largest)) r = {size, element_at_[row]};
  }
  return r;
}

bool ImplicitSteps::converge(Solver& s, ImplicitRecord& record, const Base& base,
                             const Progress& progress) {
  for (std::int32_t u = 0; u < s.model.num_dofs; ++u)
    if (const std::int32_t row = matrix_.row_of()[u]; row >= 0) x_[row] = start_.velocity[u];
  for (std::size_t i = 0; i < start_.pressure.size(); ++i)
    if (const std::int32_t q = s.water.equation[i]; q < s.water.num_equations)
      x_[matrix_.motions() + q] = start_.pressure[i];
  matrix_.factorise(s, s.dt, settings_.theta);
  anderson_.restart();
  for (int i = 1; i <= settings_.max_iterations && !progress.should_stop(); ++i) {
    ++record.iterations;
    const Residual r = evaluate(s, base);
    if (!std::isfinite(r.largest)) return false;
    last_ = r;
    // The first evaluation is of a guess: small motions would hide below the tolerance for ever.
    if (i > 1 && r.largest <= 1.0) {
      record.most_iterations = std::max(record.most_iterations, i);
      return true;
    }
    matrix_.solve(residual_, change_);
    change_ *= -1.0;
    anderson_.advance(x_, change_);
  }
  return false;
}

void ImplicitSteps::accept(Solver& s, const Base& base) {
  State& t = s.state;
  Energy& energy = t.energy;
  energy.kinetic = 0.0;
  for (std::int32_t u = 0; u < s.model.num_dofs; ++u) {
    const std::int32_t row = matrix_.row_of()[u];
    const double after = row >= 0 ? x_[row] : base.end, before = start_.velocity[u];
    const double v = middle_[u], m = s.layout.mass[u];
    const double weight = s.layout.weight[u] + s.model.load[u], lost = s.dashpot[u] * v;
    const double drive = row >= 0 ? s.base_drive[u] * base.mean
                                  : m * (after - before) / s.dt + lost + internal_[u] - weight;
    energy.kinetic += 0.5 * m * after * after;
    energy.deformation += s.dt * internal_[u] * v;
    // what the rule itself takes from the motion where theta is above 1/2 is damping, too
    energy.damping += s.dt * lost * v + (settings_.theta - 0.5) * m * pow(after - before, 2);
    energy.weight += s.dt * weight * v;
    energy.base += s.dt * drive * v;
    t.velocity[u] = after;
    t.displacement[u] += s.dt * v;
  }
  for (const Solver::ChunkSums& sums : s.element_sums) energy.viscous += sums.viscous;
  for (std::size_t i = 0; i < t.pressure.size(); ++i)
    if (const std::int32_t q = s.water.equation[i]; q < s.water.num_equations)
      t.pressure[i] = x_[matrix_.motions() + q];
  t.stress = end_stress_;
  t.hourglass_x = end_hourglass_x_;
  t.hourglass_y = end_hourglass_y_;
  t.last_dt = s.dt;
  t.time += s.dt;
  ++t.step;
}

bool ImplicitSteps::advance(Solver& s, ImplicitRecord& record, double left,
                            const std::function<double(double)>& ground, const Progress& progress) {
  start_ = s.state;
  const ImplicitRecord record_before = record;
  const auto counters_before = s.counters;
  const double dt_before = s.dt;
  const double theta = settings_.theta, now = s.state.time;
  Base base;
  for (;;) {
    const double allowed = std::ldexp(settings_.step, -record.halvings);
    s.dt = left / std::max(1.0, std::ceil(left / allowed - 1e-9));
    base.end = ground(now + s.dt);
    base.mean = (1.0 - theta) * ground(now) + theta * base.end;
    if (converge(s, record, base, progress)) break;
    s.state = start_;
    if (progress.should_stop()) {
      record = record_before;
      s.counters = counters_before;
      s.dt = dt_before;
      return false;
    }
    ++record.cut;
    if (0.5 * allowed < settings_.smallest_step) {
      const std::int64_t tag =
          last_.element < 0 ? -1 : s.model.mesh.element_tags[s.layout.order[last_.element]];
      throw NumericsError(fmt::format(
          "the implicit step {} at {:.5f} s failed to converge ({} iterations with {:.3g} s, the "
          "smallest step allowed; the largest residual, {:.3g} of the weight there, is at element "
          "{}) raise integration.tolerance or integration.max_iterations, or integrate "
          "explicitly, which needs no iterations",
          s.state.step, now, settings_.max_iterations, s.dt, last_.largest * settings_.tolerance,
          tag));
    }
    ++record.halvings;
    record.in_a_row = 0;
  }
  accept(s, base);
  if (record.halvings > 0 && ++record.in_a_row >= kStepsToGrow) {
    --record.halvings;
    record.in_a_row = 0;
  }
  return true;
}

}  // namespace flowslide::fem
