#include "bench/fem/speed.hpp"
#include "core/elementary.hpp"
#include "verify/fem/scene.hpp"

#include <algorithm>
#include <array>
#include <chrono>

#include <omp.h>

namespace flowslide::fem {
namespace {

constexpr double kFrequency = 2.0;       ///< of the base [Hz]
constexpr double kVelocity = 0.25;       ///< of the base [m/s]: 0.32 g
constexpr double kUntilLiquefied = 3.0;  ///< time of shaking before the second measurement [s]

double ground(double t) { return kVelocity * sin(2.0 * kPi * kFrequency * t); }

void step(Solver& s) { advance(s, {ground(s.state.time), ground(s.state.time + s.dt)}); }

struct Cost {
  double cpu = 1e300, wall = 1e300;  ///< of a step, the best of several batches [s]
};

Cost best_of(Solver& s, int threads, int batches, int steps) {
  using Clock = std::chrono::steady_clock;
  omp_set_num_threads(threads);
  step(s);
  Cost best;
  for (int b = 0; b < batches; ++b) {
    const double cpu = thread_seconds();
    const Clock::time_point wall = Clock::now();
    for (int i = 0; i < steps; ++i) step(s);
    best.cpu = std::min(best.cpu, (thread_seconds() - cpu) / steps);
    best.wall =
        std::min(best.wall, std::chrono::duration<double>(Clock::now() - wall).count() / steps);
  }
  return best;
}

Measurement measure(Solver& s, const std::string& soil) {
  const auto elements = static_cast<double>(s.layout.elements.size());
  const int steps = std::clamp(static_cast<int>(2e5 / elements), 20, 200);
  const Counters before = s.counters;
  const std::int64_t first = s.state.step;
  const Cost one = best_of(s, 1, 3, steps);
  const double updates = elements * static_cast<double>(s.state.step - first);
  Measurement m;
  m.name = fmt::format("fem/step/{}/{}", soil, s.layout.elements.size());
  m.value = 1e-6 * elements / one.cpu;
  m.unit = "Melements/s/core";
  m.numbers["ns_per_element"] = 1e9 * one.cpu / elements;
  m.numbers["sub_steps_per_element"] =
      static_cast<double>(s.counters.sub_steps - before.sub_steps) / updates;
  m.numbers["step_s"] = s.dt;
  m.numbers["band_width"] = s.water.factor.bandwidth();
  if (omp_get_num_procs() > 1)
    m.numbers["efficiency_2_threads_percent"] = 50.0 * one.wall / best_of(s, 2, 3, steps).wall;
  omp_set_num_threads(1);
  return m;
}

/// Level saturated ground 20 m deep.
Solver level_ground(int rows, const FemMaterialConfig& soil) {
  const Rectangle r{.columns = 2 * rows, .rows = rows, .width = 40.0, .height = 20.0};
  FemConfig c = config(soil, 20.0);
  c.damping.stiffness = 1e-3;
  return at_rest(section(r), c);
}

}  // namespace

std::vector<Measurement> measure_step() {
  const int threads = omp_get_max_threads();
  omp_set_num_threads(1);
  std::vector<Measurement> all;
  for (const int rows : {16, 32, 64}) {
    Solver elastic = level_ground(rows, elastic_soil());
    all.push_back(measure(elastic, "linear_elastic"));
    Solver sandy = level_ground(rows, sand());
    all.push_back(measure(sandy, "pm4sand"));
    if (rows > 32) continue;
    while (sandy.state.time < kUntilLiquefied) {
      if (sandy.state.step % 16 == 0) refresh_moduli(sandy);
      step(sandy);
    }
    all.push_back(measure(sandy, "pm4sand_liquefied"));
  }
  omp_set_num_threads(threads);
  return all;
}

}  // namespace flowslide::fem
