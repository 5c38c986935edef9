#include "constitutive/modified_cam_clay.hpp"
#include "constitutive/norsand.hpp"

#include <catch2/catch.hpp>

using namespace flowslide;

namespace {

ModifiedCamClay::Params clay() {
  ModifiedCamClay::Params p;
  p.critical_ratio = 1.1;
  p.compression_index = 0.1;
  p.swelling_index = 0.02;
  p.poisson_ratio = 0.25;
  return p;
}

NorSand::Params sand(double void_ratio, double image) {
  NorSand::Params p;
  p.critical_ratio = 1.25;
  p.csl_void_ratio = 0.9;
  p.csl_slope = 0.03;
  p.dilatancy = 3.5;
  p.hardening = 150.0;
  p.shear_modulus = 50e6;
  p.void_ratio = void_ratio;
  p.image_pressure = image;
  return p;
}

template <class M>
struct Cell {
  typename M::Constants c;
  StressUpdate<typename M::State, 3> now;

  Cell(const typename M::Params& p, double pressure)
      : c(M::constants(p, 1.0)), now{{{-pressure, -pressure, -pressure}}, M::initial_state(p)} {}
  [[nodiscard]] double p() const { return -mean_stress(now.stress); }
  [[nodiscard]] double q() const { return equivalent_shear(now.stress); }
  void take(const StrainIncrement<3>& de) {
    now = M::template update<3>(c, now.state, now.stress, de);
  }
  /// Axial shortening at constant volume.
  void undrained(double strain, double step) {
    for (double e = 0.0; e < strain; e += step)
      take({{0.5 * step, 0.5 * step, -step, 0.0, 0.0, 0.0}});
  }
  /// Axial shortening at constant lateral stress: the lateral strain by secants.
  void drained(double step) {
    const double held = -100e3;
    double a = 0.2 * step, b = 0.6 * step;
    const auto off = [&](double lateral) {
      return M::template update<3>(c, now.state, now.stress, {{lateral, lateral, -step, 0, 0, 0}})
                 .stress[0] -
             held;
    };
    double fa = off(a), fb = off(b);
    for (int i = 0; i < 30 && std::abs(fb) > 1e-4; ++i) {
      const double next = b - fb * (b - a) / (fb - fa);
      a = b, fa = fb;
      b = next, fb = off(b);
    }
    take({{b, b, -step, 0.0, 0.0, 0.0}});
  }
};

}  // namespace

TEST_CASE("Cam Clay reaches its undrained strength whatever its overconsolidation",
          "[constitutive]") {
  const double ratio = GENERATE(1.0, 1.5, 4.0, 10.0);
  ModifiedCamClay::Params p = clay();
  p.preconsolidation = ratio * 100e3;
  Cell<ModifiedCamClay> cell(p, 100e3);
  cell.undrained(0.6, 1e-4);
  // kappa* ln(p/p0) + (lambda* - kappa*) ln(p_c/p_c0) = 0 and p_c = 2 p at the critical state.
  const double lambda = 1.0 - p.swelling_index / p.compression_index;
  const double expected = 100e3 * std::pow(0.5 * ratio, lambda);
  CAPTURE(ratio);
  CHECK(cell.p() == Approx(expected).epsilon(2e-3));
  CHECK(cell.q() == Approx(1.1 * expected).epsilon(2e-3));
  CHECK(cell.now.state.preconsolidation == Approx(2.0 * expected).epsilon(4e-3));
}

TEST_CASE("Cam Clay compresses along its two lines", "[constitutive]") {
  ModifiedCamClay::Params p = clay();
  p.preconsolidation = 200e3;
  Cell<ModifiedCamClay> cell(p, 100e3);
  const auto squeeze = [&](double total) {
    for (int i = 0; i < 1000; ++i)
      cell.take({{-total / 3e3, -total / 3e3, -total / 3e3, 0.0, 0.0, 0.0}});
  };
  squeeze(p.swelling_index * std::log(2.0));
  CHECK(cell.p() == Approx(200e3).epsilon(1e-6));
  squeeze(p.compression_index * std::log(3.0));
  CHECK(cell.p() == Approx(600e3).epsilon(1e-3));
  squeeze(-p.swelling_index * std::log(6.0));
  CHECK(cell.p() == Approx(100e3).epsilon(1e-3));
}

TEST_CASE("Cam Clay fails drained on the stress path", "[constitutive]") {
  ModifiedCamClay::Params p = clay();
  p.preconsolidation = 100e3;
  Cell<ModifiedCamClay> cell(p, 100e3);
  for (int i = 0; i < 12000; ++i) cell.drained(1e-4);
  CHECK(cell.q() == Approx(3.0 * 1.1 * 100e3 / (3.0 - 1.1)).epsilon(5e-3));
}

TEST_CASE("NorSand ends on the critical state line of its void ratio", "[constitutive]") {
  // Loose contracts and loses strength, dense dilates and gains it: both end where e lies on the
  // line.
  const double start = 100e3;
  const double e = GENERATE(0.80, 0.755, 0.74);
  Cell<NorSand> cell(sand(e, start / std::exp(1.0) * 1.05), start);
  double peak = 0.0;
  for (int i = 0; i < 60; ++i) {
    cell.undrained(0.01, 1e-4);
    peak = std::max(peak, cell.q());
  }
  const double expected = 1e3 * std::exp((0.9 - e) / 0.03);
  CAPTURE(e, expected);
  CHECK(cell.p() == Approx(expected).epsilon(0.03));
  CHECK(cell.q() == Approx(1.25 * cell.p()).epsilon(0.02));
  CHECK((peak > 1.2 * cell.q()) == (e > 0.79));  // only the loose one falls after a peak
}

TEST_CASE("Dense NorSand peaks at the stress ratio its dilatancy allows", "[constitutive]") {
  const double e = 0.68;
  const NorSand::Params p = sand(e, 100e3 / std::exp(1.0) * 1.05);
  Cell<NorSand> cell(p, 100e3);
  double peak = 0.0, limit = 0.0;
  for (int i = 0; i < 1500; ++i) {
    cell.drained(1e-4);
    const double ratio = cell.q() / cell.p();
    if (ratio <= peak) continue;
    peak = ratio;
    // eta = M_i - D with D_min = chi_i psi_i of the state at the peak.
    const double chi = p.dilatancy / (1.0 - p.csl_slope * p.dilatancy / p.critical_ratio);
    const double psi =
        NorSand::state_parameter(p, cell.now.state.void_ratio, cell.now.state.image_pressure);
    limit = p.critical_ratio - p.coupling * chi * std::abs(psi) - chi * psi;
  }
  CHECK(peak > 1.1 * p.critical_ratio);
  CHECK(cell.now.state.void_ratio > e);
  CHECK(peak == Approx(limit).epsilon(0.03));
}

TEST_CASE("The critical-state laws treat plane strain as three dimensions", "[constitutive]") {
  ModifiedCamClay::Params mcc = clay();
  mcc.preconsolidation = 150e3;
  const auto c = ModifiedCamClay::constants(mcc, 1.0);
  const auto n = NorSand::constants(sand(0.75, 60e3), 1.0);
  for (int i = 0; i < 2000; ++i) {
    const double a = 0.001 * std::sin(1.0 * i), b = 0.001 * std::cos(2.7 * i),
                 g = 0.002 * std::sin(0.3 * i);
    const Stress<2> flat{{-90e3 + 20e3 * std::sin(0.7 * i), -100e3, -80e3, 15e3 * std::cos(i)}};
    const Stress<3> solid{{flat[0], flat[1], flat[2], flat[3]}};
    const auto check = [&](const auto& two, const auto& three) {
      for (int k = 0; k < 4; ++k) {
        REQUIRE(std::isfinite(two.stress[k]));
        REQUIRE(two.stress[k] == Approx(three.stress[k]).epsilon(1e-9).margin(1e-3));
      }
    };
    check(ModifiedCamClay::update<2>(c, ModifiedCamClay::initial_state(mcc), flat,
                                     StrainIncrement<2>{{a, b, 0.0, g}}),
          ModifiedCamClay::update<3>(c, ModifiedCamClay::initial_state(mcc), solid,
                                     StrainIncrement<3>{{a, b, 0.0, g}}));
    check(NorSand::update<2>(n, NorSand::initial_state(n.p), flat,
                             StrainIncrement<2>{{a, b, 0.0, g}}),
          NorSand::update<3>(n, NorSand::initial_state(n.p), solid,
                             StrainIncrement<3>{{a, b, 0.0, g}}));
  }
}
