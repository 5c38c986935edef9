#include "bench/mpm/column.hpp"
#include "bench/mpm/speed.hpp"

#include <algorithm>
#include <fstream>
#include <malloc.h>

#include <fmt/format.h>

/// Bodies that fill most of a machine: whether a step stays as fast per point, and what a point
/// takes of memory.
namespace flowslide::mpm {
namespace {

/// A line of /proc/self/status [bytes]; not a number where there is none.
double memory_of_process(const std::string& key) {
  std::ifstream status("/proc/self/status");
  for (std::string word; status >> word;) {
    double kilobytes = 0.0;
    if (word == key && status >> kilobytes) return 1024.0 * kilobytes;
  }
  return kUnset;
}

/// From now on VmHWM is the peak since now.
void forget_peak() { std::ofstream("/proc/self/clear_refs") << 5; }

/// A body and the buffers of its steps on one thread.
template <int Dim>
struct Body {
  Simulation<Dim> s;
  StepScratch<Dim> scratch{1};
  double best = 1e300;  ///< processor seconds of the best step so far
  Body(int side, BenchLaw law) : s(bench_column<Dim>(side, BasisKind::quadratic, law)) {
    prepare(s, scratch, true);
    constexpr int kWarm = 2;
    for (int i = 0; i < kWarm; ++i) advance(s, scratch);
  }
  void measure(int steps) {
    for (int i = 0; i < steps; ++i) {
      const double start = thread_seconds();
      advance(s, scratch);
      best = std::min(best, thread_seconds() - start);
    }
  }
  [[nodiscard]] double points() const { return double(s.points.size()); }
  [[nodiscard]] double rate() const { return 1e-6 * points() / best; }
};

template <int Dim>
Measurement compare(int usual_side, int large_side, BenchLaw law) {
  // As in a new process: large arrays are the system's, and what earlier bodies left is not used
  // again unseen.
  mallopt(M_MMAP_THRESHOLD, 1 << 20);
  malloc_trim(0);
  const double before = memory_of_process("VmRSS:");
  forget_peak();
  Body<Dim> large(large_side, law);
  const double peak = memory_of_process("VmHWM:");
  Body<Dim> usual(usual_side, law);
  // In turns, so that both meet the same load of the machine.
  constexpr int kRounds = 3, kSteps = 2;
  for (int round = 0; round < kRounds; ++round) {
    usual.measure(4 * kSteps);
    large.measure(kSteps);
  }
  Measurement m;
  m.name = fmt::format("mpm/large/{}d/{}/{}", Dim, law_name(law), large.s.points.size());
  m.value = large.rate();
  m.unit = "Mupdates/s/core";
  m.numbers["usual_points"] = usual.points();
  m.numbers["usual_mupdates_per_s"] = usual.rate();
  m.numbers["percent_of_usual"] = 100.0 * large.rate() / usual.rate();
  m.numbers["peak_bytes_per_point"] = (peak - before) / large.points();
  return m;
}

}  // namespace

std::vector<Measurement> measure_large() {
  std::vector<Measurement> all;
  for (const BenchLaw law : {BenchLaw::mohr_coulomb, BenchLaw::residual_strength}) {
    all.push_back(compare<2>(800, 3163, law));
    all.push_back(compare<3>(90, 126, law));
  }
  return all;
}

}  // namespace flowslide::mpm
