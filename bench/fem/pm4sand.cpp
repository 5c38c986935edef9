#include "bench/fem/speed.hpp"
#include "constitutive/pm4sand_lanes.hpp"
#include "core/elementary.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace flowslide::fem {
namespace {

constexpr int kPoints = 32;  ///< as many as the step of the finite elements takes at a time
constexpr int kCycles = 12;  ///< of 0.5 s
constexpr int kCallsPerCycle = 1000;  ///< as in a run with steps of 0.5 ms

/// Points of the tailings of the Mochikoshi dam under level ground, 20 to 268 kPa.
struct Points {
  PM4Sand::Constants constants;
  std::array<PM4Sand::State, kPoints> state;
  std::array<Stress<2>, kPoints> stress;
  std::array<double, kPoints> vertical{};
};

Points consolidated(double increment, double tolerance) {
  PM4Sand::Params p;
  p.Dr = 0.35;
  p.G0 = 476.0;
  p.hpo = 2.70;
  p.Q = 11.998;
  p.R = 3.75;
  p.max_strain_increment = increment;
  p.tolerance = tolerance;
  Points r;
  r.constants = PM4Sand::constants(p);
  for (int i = 0; i < kPoints; ++i) {
    r.vertical[i] = 20e3 + 8e3 * i;
    r.stress[i] = {{-0.5 * r.vertical[i], -r.vertical[i], -0.5 * r.vertical[i], 0.0}};
    r.state[i] = PM4Sand::initial_state(r.constants, r.stress[i]);
  }
  return r;
}

/// Shear strain at constant volume: cycles from 2e-4 up to 2 %, the soil liquefies on the way.
double shear_strain(int call) {
  const double cycles = static_cast<double>(call) / kCallsPerCycle;
  return 2e-4 * pow(100.0, cycles / kCycles) * sin(2.0 * kPi * cycles);
}

struct Outcome {
  std::vector<double> stress;  ///< mean and shear stress over the vertical, at every 20th call
  double seconds = 1e300;      ///< the best of several runs
  double sub_steps = 0.0, rejected = 0.0;
};

Outcome shear(double increment, double tolerance, int repeats) {
  Outcome r;
  for (int repeat = 0; repeat < repeats; ++repeat) {
    Points points = consolidated(increment, tolerance);
    r.stress.clear();
    r.sub_steps = r.rejected = 0.0;
    const double start = thread_seconds();
    for (int call = 0; call < kCycles * kCallsPerCycle; ++call) {
      const double step = shear_strain(call + 1) - shear_strain(call);
      const StrainIncrement<2> de{{0.0, 0.0, 0.0, step}};
      int next = 0;
      const PM4Sand::Work w = PM4Sand::update_all([&](PM4Sand::Task& task) {
        if (next == kPoints) return false;
        task = {&points.constants, &points.state[next], &points.stress[next], de};
        ++next;
        return true;
      });
      r.sub_steps += w.sub_steps;
      r.rejected += w.rejected;
      if (call % 20 != 0) continue;
      for (int i = 0; i < kPoints; ++i) {
        const Stress<2>& s = points.stress[i];
        r.stress.push_back(0.5 * (s[0] + s[1]) / points.vertical[i]);
        r.stress.push_back(s[3] / points.vertical[i]);
      }
    }
    r.seconds = std::min(r.seconds, thread_seconds() - start);
  }
  return r;
}

double rms_difference(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
  return std::sqrt(2.0 * sum / static_cast<double>(a.size()));
}

}  // namespace

std::vector<Measurement> measure_pm4sand() {
  const Outcome reference = shear(4e-6, 1e-7, 1);
  std::vector<Measurement> all;
  constexpr std::array<std::array<double, 2>, 8> settings{{{1.0, 1e-2},
                                                           {1.0, 1e-3},
                                                           {1.0, 1e-4},
                                                           {1.0, 1e-5},
                                                           {1e-4, 1e-4},
                                                           {1e-5, 1.0},
                                                           {1e-5, 1e-5},
                                                           {1e-5, 1e-6}}};
  for (const auto& [increment, tolerance] : settings) {
    const Outcome r = shear(increment, tolerance, 2);
    Measurement m;
    m.name = fmt::format("fem/pm4sand/increment_{:.0e}/tolerance_{:.0e}", increment, tolerance);
    m.value = 1e-6 * r.sub_steps / r.seconds;
    m.unit = "Msub-steps/s/core";
    m.numbers["max_strain_increment"] = increment;
    m.numbers["tolerance"] = tolerance;
    m.numbers["stress_error"] = rms_difference(r.stress, reference.stress);
    m.numbers["sub_steps_per_call"] = r.sub_steps / (1.0 * kPoints * kCycles * kCallsPerCycle);
    m.numbers["rejected_percent"] = 100.0 * r.rejected / r.sub_steps;
    m.numbers["ns_per_call"] = 1e9 * r.seconds / (1.0 * kPoints * kCycles * kCallsPerCycle);
    all.push_back(std::move(m));
  }
  return all;
}

}  // namespace flowslide::fem
