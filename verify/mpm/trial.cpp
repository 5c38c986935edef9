#include "verify/mpm/trial.hpp"

#include "core/elementary.hpp"

#include <cmath>

namespace flowslide::mpm {
void fill(ParticleSet& p, const Area& area, double spacing, double density, std::int32_t material) {
  fill(p, area, spacing, density, material, [](double, double) { return true; });
}

MaterialSpec material(const std::string& law, std::map<std::string, double> parameters) {
  return {law, law, std::move(parameters), true};
}

MaterialSpec elastic(double youngs_modulus, double poisson_ratio) {
  return material("linear_elastic",
                  {{"youngs_modulus", youngs_modulus}, {"poisson_ratio", poisson_ratio}});
}

FlowConfig free_space(double cell) {
  FlowConfig c;
  c.cell = cell;
  c.end = 1.0;
  c.gravity = 0.0;
  c.transfer = Transfer::apic;
  c.ground.surface = {{0.0, -1e6}};
  c.softening.reference_length = 1.25;
  return c;
}

Trial::Trial(const ParticleSet& particles, const FlowConfig& config)
    : sim(make_simulation(particles, config)) {
  rebin();
  reference = {sum_points(sim), is_set(particles.toe) ? particles.toe : 0.0};
}

void Trial::rebin() { prepare(sim, scratch, true); }

double Trial::next_dt() const { return stable_step(sim); }

void Trial::step() {
  scratch.scattered = false;  // scenes change points by hand between steps
  advance(sim, scratch);
  if (!std::isfinite(sim.last.max_speed2) || !(sim.dt > 0.0))
    throw NumericsError(
        fmt::format("step {}, t = {:.4g} s: velocities are no longer finite (the scheme is "
                    "unstable here) this is a defect of the program",
                    sim.step, sim.time));
}

void Trial::damp(double rate) {
  const double keep = exp(-rate * sim.dt);
  for (auto& component : sim.points.v)
    for (double& v : component) v *= keep;
  for (auto& component : sim.points.c)
    for (double& c : component) c *= keep;
}

void Trial::run_to(double time) {
  while (sim.time < time) step();
}

MpmSample Trial::balances() const {
  std::vector<Place> buffer;
  return sample(sim, reference, std::vector<bool>(sim.materials.size(), true), buffer);
}

double fitted_order(const std::vector<double>& cells, const std::vector<double>& errors) {
  double mean_x = 0.0, mean_y = 0.0;
  const auto n = static_cast<double>(cells.size());
  for (std::size_t i = 0; i < cells.size(); ++i) {
    mean_x += log(cells[i]) / n;
    mean_y += log(errors[i]) / n;
  }
  double xy = 0.0, xx = 0.0;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const double dx = log(cells[i]) - mean_x;
    xy += dx * (log(errors[i]) - mean_y);
    xx += dx * dx;
  }
  return xy / xx;
}

}  // namespace flowslide::mpm
