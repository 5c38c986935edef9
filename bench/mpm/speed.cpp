#include "bench/mpm/speed.hpp"

#include "bench/mpm/bandwidth.hpp"
#include "bench/mpm/column.hpp"

#include <algorithm>
#include <chrono>

#include <omp.h>

namespace flowslide::mpm {
namespace {

/// Best seconds of one step, of processor time and of wall time.
struct StepTime {
  double cpu = 1e300, wall = 1e300;
};

template <int Dim>
StepTime best_step(Simulation<Dim>& s, StepScratch<Dim>& scratch, int repeats) {
  using Clock = std::chrono::steady_clock;
  StepTime best;
  for (int i = 0; i < repeats; ++i) {
    const double cpu = thread_seconds();
    const Clock::time_point wall = Clock::now();
    advance(s, scratch);
    best.cpu = std::min(best.cpu, thread_seconds() - cpu);
    best.wall = std::min(best.wall, std::chrono::duration<double>(Clock::now() - wall).count());
  }
  return best;
}

template <int Dim>
Measurement measure(BasisKind basis, std::string_view basis_name, BenchLaw law, int side) {
  Simulation<Dim> s = bench_column<Dim>(side, basis, law);
  const auto points = double(s.points.size());
  const int repeats = std::clamp(static_cast<int>(2e6 / points), 4, 30);
  StepScratch<Dim> one(1), two(2);
  prepare(s, one, true);
  for (int i = 0; i < 6; ++i) advance(s, one);
  StepTime serial, parallel;
  // In turns, so that both meet the same load of the machine.
  for (int round = 0; round < 3; ++round) {
    prepare(s, one, true);
    const StepTime a = best_step(s, one, repeats);
    serial = {std::min(serial.cpu, a.cpu), std::min(serial.wall, a.wall)};
    if (omp_get_num_procs() < 2) continue;
    prepare(s, two, true);
    const StepTime b = best_step(s, two, repeats);
    parallel = {std::min(parallel.cpu, b.cpu), std::min(parallel.wall, b.wall)};
  }
  const double bytes = bytes_per_update(s, law);
  const double bandwidth = triad_bandwidth(static_cast<std::size_t>(bytes * points));
  Measurement m;
  m.name = fmt::format("mpm/{}d/{}/{}/{}", Dim, basis_name, law_name(law), s.points.size());
  m.value = 1e-6 * points / serial.cpu;
  m.unit = "Mupdates/s/core";
  m.texts["compiler"] = __VERSION__;
  m.texts["flags"] = FLOWSLIDE_FLAGS;
  m.numbers["ns_per_update"] = 1e9 * serial.cpu / points;
  m.numbers["bytes_per_update"] = bytes;
  m.numbers["triad_gb_per_s"] = 1e-9 * bandwidth;
  m.numbers["roofline_percent"] = 100.0 * bytes * points / serial.cpu / bandwidth;
  if (parallel.wall < 1e300)
    m.numbers["efficiency_2_threads_percent"] = 50.0 * serial.wall / parallel.wall;
  return m;
}

template <int Dim>
std::vector<Measurement> measure_all(BasisKind basis, std::string_view name) {
  std::vector<Measurement> all;
  for (const int side : {Dim == 2 ? 200 : 40, Dim == 2 ? 800 : 90})
    for (const BenchLaw law :
         {BenchLaw::linear_elastic, BenchLaw::mohr_coulomb, BenchLaw::residual_strength})
      all.push_back(measure<Dim>(basis, name, law, side));
  return all;
}

}  // namespace

template <int Dim>
std::vector<Measurement> measure_quadratic() {
  return measure_all<Dim>(BasisKind::quadratic, "quadratic");
}
template <int Dim>
std::vector<Measurement> measure_linear() {
  return measure_all<Dim>(BasisKind::linear, "linear");
}
template std::vector<Measurement> measure_quadratic<2>();
template std::vector<Measurement> measure_quadratic<3>();
template std::vector<Measurement> measure_linear<2>();
template std::vector<Measurement> measure_linear<3>();

}  // namespace flowslide::mpm
