#include "bench/mpm/bandwidth.hpp"
#include "bench/mpm/speed.hpp"
#include "mpm/run/load.hpp"
#include "verify/mpm/dam.hpp"

#include <algorithm>
#include <chrono>
#include <sys/resource.h>

#include <omp.h>

namespace flowslide::mpm {

std::vector<Measurement> measure_valley() {
  using Clock = std::chrono::steady_clock;
  DamScene scene;
  scene.cell = 1.46;
  scene.width = 73.0;
  Simulation<3> s = make_simulation<3>(dam_points(scene), dam_config(scene));
  const auto points = double(s.points.size());
  StepScratch<3> scratch(omp_get_num_procs());
  prepare(s, scratch, true);
  constexpr int kWarm = 2, kSteps = 6;
  for (int i = 0; i < kWarm; ++i) advance(s, scratch);
  double best = 1e300;
  for (int i = 0; i < kSteps; ++i) {
    const Clock::time_point start = Clock::now();
    advance(s, scratch);
    best = std::min(best, std::chrono::duration<double>(Clock::now() - start).count());
  }
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  Measurement m;
  m.name = fmt::format("mpm/3d/valley/{}", s.points.size());
  m.value = 1e-6 * points / best;
  m.unit = "Mupdates/s";
  m.numbers["threads"] = double(scratch.tile.size());
  m.numbers["seconds_per_step"] = best;
  m.numbers["step_s"] = s.dt;
  m.numbers["peak_memory_gib"] = double(usage.ru_maxrss) / 1048576.0;
  return {m};
}

}  // namespace flowslide::mpm
