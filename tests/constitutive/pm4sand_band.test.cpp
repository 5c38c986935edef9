#include "tests/constitutive/pm4sand_samples.hpp"

#include <algorithm>

#include <catch2/catch.hpp>

/// A length for softening: docs/theory/pm4sand.md.
using namespace flowslide;
using namespace flowslide::testing;

namespace {

constexpr double kIncrement = 1e-5, kLargest = 0.06;

struct Sample {
  PM4Sand::Constants c = PM4Sand::constants(pm4sand_tailings());
  Stress<2> stress{{-100e3, -100e3, -100e3, 0.0}};
  PM4Sand::State state = PM4Sand::initial_state(c, stress);

  explicit Sample(double band) { state.band = band; }
  void shear(double gamma) {
    const auto r = PM4Sand::update(c, state, stress, {{0.0, 0.0, 0.0, gamma}});
    stress = r.stress;
    state = r.state;
  }
};

struct Path {
  std::vector<double> gamma, tau;
  [[nodiscard]] double at(double strain) const {
    const auto i = static_cast<std::size_t>(std::lower_bound(gamma.begin(), gamma.end(), strain) -
                                            gamma.begin());
    const double t = (strain - gamma[i - 1]) / (gamma[i] - gamma[i - 1]);
    return tau[i - 1] + t * (tau[i] - tau[i - 1]);
  }
};

Path sheared(double band) {
  Path path{{0.0}, {0.0}};
  Sample s(band);
  while (path.gamma.back() < kLargest) {
    s.shear(kIncrement);
    path.gamma.push_back(path.gamma.back() + kIncrement);
    path.tau.push_back(s.stress[3]);
  }
  return path;
}

/// A band that takes the share `f` of the height, in series with soil that unloads elastically with
/// the same modulus, from the peak on.
Path band_in_series(double f) {
  Path path{{0.0}, {0.0}};
  Sample s(1.0);
  while (path.gamma.back() < kLargest) {
    const double shear = PM4Sand::elasticity(s.c, s.state, s.stress).shear;
    s.shear(kIncrement);
    const double rise = s.stress[3] - path.tau.back();
    const double beyond_peak = f * kIncrement + (1.0 - f) * rise / shear;
    path.gamma.push_back(path.gamma.back() + (rise < 0.0 ? beyond_peak : kIncrement));
    path.tau.push_back(s.stress[3]);
  }
  return path;
}

}  // namespace

TEST_CASE("Beyond the peak an element shears as a band of the length and elastic soil in series",
          "[pm4sand]") {
  const Path none = sheared(1.0);
  const double peak = *std::ranges::max_element(none.tau);
  for (const double f : {0.5, 0.8, 1.25, 2.0}) {
    const Path found = sheared(f), expected = band_in_series(f);
    double largest = 0.0, control = 0.0;
    for (const double strain : {0.002, 0.01, 0.02, 0.03, 0.05}) {
      largest = std::max(largest, std::abs(found.at(strain) - expected.at(strain)) / peak);
      control = std::max(control, std::abs(none.at(strain) - expected.at(strain)) / peak);
    }
    INFO(f << ": " << largest << ", control " << control);
    CHECK(largest < 1e-3);  // 1e-4 is the error of steps of 1e-5
    CHECK(control > 0.03);
    // hardening knows no length; the sub-step that passes the peak does
    CHECK(std::abs(*std::ranges::max_element(found.tau) - peak) < 1e-6 * peak);
  }
}

TEST_CASE("An element far larger than the length of softening does not gain strength",
          "[pm4sand]") {
  const Path coarse = sheared(0.01), none = sheared(1.0);
  for (const double strain : {0.01, 0.02, 0.03, 0.05}) {
    CHECK(coarse.at(strain) > 0.0);
    CHECK(coarse.at(strain) < none.at(strain));
  }
}
