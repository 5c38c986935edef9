#pragma once
#include "core/conventions.hpp"
#include "mpm/run/flow.hpp"
#include "mpm/run/load.hpp"
#include "mpm/solver/balance.hpp"
#include "mpm/solver/checkpoint.hpp"

#include <random>
#include <string>

/// Small scenes for the tests of this folder.
namespace flowslide::mpm {

inline MaterialSpec elastic(double young, double nu) {
  return {"elastic", "linear_elastic", {{"youngs_modulus", young}, {"poisson_ratio", nu}}, true};
}
inline MaterialSpec liquefied(double young, double strength) {
  return {"liquefied",
          "residual_strength",
          {{"youngs_modulus", young},
           {"poisson_ratio", 0.49},
           {"strength", strength},
           {"soft_strength", 0.5 * strength}},
          true};
}

struct Box {
  double x0, y0, x1, y1;
};

/// Appends points at the centres of squares of side `spacing` that fill the box.
inline void add_lattice(ParticleSet& p, const Box& box, double spacing, double density,
                        std::int32_t material = 0) {
  const auto nx = static_cast<int>(std::lround((box.x1 - box.x0) / spacing));
  const auto ny = static_cast<int>(std::lround((box.y1 - box.y0) / spacing));
  const std::size_t first = p.size();
  resize(p, first + std::size_t(nx) * ny);
  for (int j = 0, k = 0; j < ny; ++j) {
    for (int i = 0; i < nx; ++i, ++k) {
      const std::size_t q = first + k;
      p.position[q] = {box.x0 + (i + 0.5) * spacing, box.y0 + (j + 0.5) * spacing, 0.0};
      p.volume[q] = spacing * spacing;
      p.mass[q] = density * p.volume[q];
      p.material[q] = material;
      p.id[q] = static_cast<std::int64_t>(q) + 1;
    }
  }
}

/// Nothing but inertia and stress: no gravity, the ground out of reach.
inline FlowConfig free_space(double cell) {
  FlowConfig c;
  c.cell = cell;
  c.end = 1.0;
  c.gravity = 0.0;
  c.transfer = Transfer::apic;
  c.ground.surface = {{0.0, -1e6}};
  c.softening.reference_length = 1.25;
  return c;
}

/// What the driver of a run would remember beside the simulation.
template <int Dim>
RunState state_of(const Simulation<Dim>& s) {
  RunState r;
  r.frames = 1;
  r.first_dt = s.dt;
  r.next_frame = r.next_sample = s.time + 1.0;
  return r;
}

struct Run {
  Simulation<2> s;
  StepScratch<2> scratch;
  Reference<2> start;

  Run(const ParticleSet& particles, const FlowConfig& config, int threads = 1)
      : s(make_simulation(particles, config)), scratch(threads) {
    prepare(s, scratch, true);
    start = {sum_points(s), is_set(particles.toe) ? particles.toe : 0.0};
  }
  void step(int count = 1) {
    for (int i = 0; i < count; ++i) advance(s, scratch);
  }
  void run_to(double time) {
    while (s.time < time) step();
  }
  [[nodiscard]] MpmSample sample_now() const {
    std::vector<Place> buffer;
    return sample(s, start, std::vector<bool>(s.materials.size(), true), buffer);
  }
};

template <class F>
std::string input_error(F&& f) {
  try {
    f();
  } catch (const InputError& e) {
    return e.what();
  }
  return "(no InputError)";
}

}  // namespace flowslide::mpm
