#include "tests/mpm/scene.hpp"

#include <catch2/catch.hpp>

using namespace flowslide;
using namespace flowslide::mpm;

namespace {

constexpr double kYoung = 10e6, kPoisson = 0.25, kDensity = 2000.0;
constexpr double kShear = kYoung / (2.0 * (1.0 + kPoisson));
constexpr double kConfined =
    kYoung * (1.0 - kPoisson) / ((1.0 + kPoisson) * (1.0 - 2.0 * kPoisson));

/// A plane pulse that runs to the left through the middle of a block so wide that its upper and
/// lower side are not heard there.
struct Pulse {
  static constexpr double length = 26.0, width = 100.0, start = 10.0, scale = 4.0;
  bool shear;
  FlowConfig config = free_space(1.0);

  explicit Pulse(bool of_shear) : shear(of_shear) {
    config.transfer = Transfer::flip;
    config.flip_share = 1.0;
  }
  [[nodiscard]] double speed() const { return std::sqrt((shear ? kShear : kConfined) / kDensity); }

  /// Amplitude that has come back from the plane x = 0 when the pulse would be where it began, over
  /// the first; and the energy that left through it, over that of the pulse.
  struct Back {
    double amplitude, absorbed;
  };
  [[nodiscard]] Back comes_back() const {
    ParticleSet p;
    p.materials = {elastic(kYoung, kPoisson)};
    add_lattice(p, {0.0, 0.0, length, width}, 0.5, kDensity);
    const double lame = kConfined - 2.0 * kShear;
    for (std::size_t q = 0; q < p.size(); ++q) {
      const double s = (p.position[q][0] - start) / scale, v = 0.01 * std::exp(-s * s);
      const double strain = v / speed();  // u(x + c t)
      p.velocity[q][shear ? 1 : 0] = v;
      if (shear)
        p.stress[q][3] = kShear * strain;
      else
        p.stress[q] = {kConfined * strain, lame * strain, lame * strain, 0.0, 0.0, 0.0};
    }
    Run run(p, config);
    const double first = running(run.s, -1.0);
    const PointSums<2> sums = sum_points(run.s);
    run.run_to(2.0 * start / speed());
    return {running(run.s, 1.0) / first,
            run.s.balance.grid.absorbed / (sums.kinetic + sums.recoverable)};
  }
  /// Size of what runs to the right (1) or left (-1) in the middle of the block.
  [[nodiscard]] double running(const Simulation<2>& s, double direction) const {
    const Points<2>& p = s.points;
    double square = 0.0;
    for (std::size_t q = 0; q < p.size(); ++q) {
      if (std::abs(p.x[1][q] - 0.5 * width) > 2.0) continue;
      const double stress = p.sigma[shear ? 3 : 0][q] / (kDensity * speed());
      square += std::pow(p.v[shear ? 1 : 0][q] - direction * stress, 2);
    }
    return std::sqrt(square);
  }
};

}  // namespace

TEST_CASE("Pulses leave through an absorbing plane", "[mpm]") {
  const bool shear = GENERATE(false, true);
  const double offset = GENERATE(0.0, 0.3);
  CAPTURE(shear, offset);
  Pulse pulse(shear);
  pulse.config.grid_origin = {offset, 0.0};
  pulse.config.absorbing.left = 0.0;
  const Pulse::Back open = pulse.comes_back();
  CHECK(open.amplitude < 0.025);  // 0.06 % of the energy
  CHECK(open.absorbed > 0.85);    // the sides of the block scatter
  pulse.config.absorbing.left.reset();
  pulse.config.left_roller = 0.0;  // control: it stops P and lets the side of S slide
  CHECK(pulse.comes_back().amplitude == Approx(1.0).margin(0.05));
}

TEST_CASE("Three absorbing planes take all motion at the full step, and its energy is known",
          "[mpm]") {
  const auto basis = GENERATE(BasisKind::gimp, BasisKind::quadratic, BasisKind::cubic);
  const bool smooth = GENERATE(true, false);
  ParticleSet p;
  p.materials = {elastic(kYoung, 0.3)};
  add_lattice(p, {0.0, 0.0, 8.0, 4.0}, 0.5, kDensity);
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> any(-0.1, 0.1);
  for (std::size_t q = 0; q < p.size(); ++q) {
    const auto& x = p.position[q];
    p.velocity[q] = smooth ? std::array{0.1 * std::sin(0.4 * x[0]), 0.1 * std::cos(0.5 * x[1]), 0.0}
                           : std::array{any(random), any(random), 0.0};
  }
  FlowConfig config = free_space(1.0);
  config.basis = basis;
  config.courant = 1.0;
  config.grid_origin = {0.2, 0.4};
  config.absorbing = {0.0, 8.0, 0.0};
  if (smooth) {
    config.transfer = Transfer::flip;
    config.flip_share = 1.0;
  }
  Run run(p, config);
  double highest = 0.0;
  for (int i = 0; i < 1500; ++i) {
    run.step();
    if (i % 10 != 0) continue;
    const PointSums<2> now = sum_points(run.s);
    highest = std::max(highest, now.kinetic + now.recoverable);
  }
  const double before = run.start.start.kinetic;
  const PointSums<2> end = sum_points(run.s);
  CHECK(highest < 1.02 * before);
  CHECK(end.kinetic + end.recoverable < 1e-3 * before);
  const MpmSample sample = run.sample_now();
  CHECK(std::abs(sample.momentum_error) < 1e-9);
  CHECK(sample.friction_work == Approx(run.s.balance.grid.absorbed).epsilon(1e-9));
  CHECK(std::abs(sample.energy_error) < 0.02);
  // The rest is lost in the transfer: what stops at the plane is not smooth.
  if (smooth) CHECK(run.s.balance.grid.absorbed > 0.75 * before);
}

TEST_CASE("Soil at rest stays at rest between absorbing planes", "[mpm]") {
  const double height = 6.0, k0 = 0.5, offset = GENERATE(0.0, 0.3);
  ParticleSet p;
  p.materials = {elastic(20e6, 1.0 / 3.0)};
  add_lattice(p, {0.0, 0.0, 10.0, height}, 0.5, kDensity);
  for (std::size_t q = 0; q < p.size(); ++q) {
    const double weight = -kDensity * 9.81 * (height - p.position[q][1]);
    p.stress[q] = {k0 * weight, weight, k0 * weight, 0.0, 0.0, 0.0};
  }
  FlowConfig config = free_space(1.0);
  config.gravity = 9.81;
  config.grid_origin = {offset, offset};
  config.absorbing = {0.0, 10.0, 0.0};
  const auto sunk = [&](bool supported, double time) {
    Run run(p, config);
    run.s.contact.absorbing.supported = !supported;  // control: dashpots and springs alone
    run.run_to(time);
    double most = 0.0;
    for (std::size_t q = 0; q < run.s.points.size(); ++q)
      for (int d = 0; d < 2; ++d)
        most =
            std::max(most, std::abs(run.s.points.x[d][q] - p.position[run.s.points.index[q]][d]));
    return most;
  };
  const double early = sunk(true, 8.0);
  CHECK(early < 0.03);
  CHECK(sunk(true, 16.0) < 1.3 * early);
  CHECK(sunk(false, 1.0) > 0.05);
}

TEST_CASE("Absorbing planes are checked", "[mpm]") {
  ParticleSet p;
  p.materials = {elastic(1e6, 0.3)};
  add_lattice(p, {0.0, 0.0, 2.0, 2.0}, 0.5, 1000.0);
  const auto error = [&](auto&& change) {
    FlowConfig c = free_space(1.0);
    change(c);
    return input_error([&] { make_simulation(p, c); });
  };
  using Catch::Matchers::Contains;
  CHECK_THAT(error([](FlowConfig& c) { c.absorbing.left = c.left_roller = 0.0; }),
             Contains("left_roller are both given"));
  CHECK_THAT(error([](FlowConfig& c) { c.absorbing.left = 1.0; }),
             Contains("particle 1 ") && Contains("beyond an absorbing plane"));
  CHECK_THAT(error([](FlowConfig& c) { c.absorbing = {3.0, 1.0, {}}; }), Contains("swap them"));
  CHECK_THAT(error([](FlowConfig& c) {
               c.absorbing.bottom = 0.0;
               c.ground.surface = {{0.0, -1.0}};
             }),
             Contains("ground.surface reaches up to y = -1 m"));
}
