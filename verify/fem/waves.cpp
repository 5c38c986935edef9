#include "core/elementary.hpp"
#include "verify/fem/list.hpp"
#include "verify/fem/scene.hpp"

#include <complex>

#include <Eigen/Dense>

/// F5, F6: steady vibration of columns against closed solutions, and waves that leave.
namespace flowslide::fem {
namespace {

using Complex = std::complex<double>;
constexpr Complex kI{0.0, 1.0};

/// Amplitude over sin(w t) of a signal, by its Fourier sums over whole periods.
class Fourier {
 public:
  explicit Fourier(double omega) : omega_(omega) {}
  void add(double time, double value, double dt) {
    sine_ += value * sin(omega_ * time) * dt;
    cosine_ += value * cos(omega_ * time) * dt;
    duration_ += dt;
  }
  [[nodiscard]] double amplitude() const { return 2.0 * hypot(sine_, cosine_) / duration_; }

 private:
  double omega_, sine_ = 0.0, cosine_ = 0.0, duration_ = 0.0;
};

/// A sine that starts smoothly over `rise`.
double gentle(double omega, double time, double rise) {
  const double x = std::min(1.0, time / rise);
  return x * x * (3.0 - 2.0 * x) * sin(omega * time);
}

}  // namespace

namespace {

constexpr double kWaveColumn = 10.0;

struct Soil {
  double modulus, density, storage, mobility;
};

/// Amplitudes for a unit stress exp(i w t) on the drained top of a column on rock: displacement
/// of the top, pore pressure at the base. Modes exp(s y) of the u-p equations.
struct Response {
  double top, base;
};

Response exact_column(const Soil& m, double w) {
  const Complex a = -m.modulus * m.mobility;
  const Complex b = kI * w * (1.0 + m.modulus * m.storage) - m.density * w * w * m.mobility;
  const Complex c = kI * w * w * w * m.density * m.storage;
  const Complex root = std::sqrt(b * b - 4.0 * a * c);
  std::array<Complex, 4> s;
  s[0] = std::sqrt((-b + root) / (2.0 * a));
  s[2] = std::sqrt((-b - root) / (2.0 * a));
  s[1] = -s[0];
  s[3] = -s[2];
  Eigen::Matrix4cd A;
  Eigen::Vector4cd rhs = Eigen::Vector4cd::Zero();
  rhs[3] = 1.0;
  const auto pressure = [&](Complex x) { return (m.modulus * x * x + m.density * w * w) / x; };
  for (int j = 0; j < 4; ++j) {
    // the factor keeps exp(s H) of growing modes in range
    const Complex scale = exp(-std::max(0.0, s[j].real()) * kWaveColumn);
    A(0, j) = scale;
    A(1, j) = scale * s[j] * pressure(s[j]);
    A(2, j) = scale * pressure(s[j]) * exp(s[j] * kWaveColumn);
    A(3, j) = scale * m.modulus * s[j] * exp(s[j] * kWaveColumn);
  }
  const Eigen::Vector4cd x = A.fullPivLu().solve(rhs);
  Complex top = 0.0, base = 0.0;
  for (int j = 0; j < 4; ++j) {
    const Complex scale = exp(-std::max(0.0, s[j].real()) * kWaveColumn);
    top += x[j] * scale * exp(s[j] * kWaveColumn);
    base += x[j] * scale * pressure(s[j]);
  }
  return {std::abs(top), std::abs(base)};
}

Response computed_column(int elements, double permeability, double w) {
  FemConfig c = config(elastic_soil(10e6, 0.25), kWaveColumn);
  c.materials["soil"].permeability = {permeability, permeability};
  const double h = kWaveColumn / elements;
  Solver s =
      at_rest(section({.columns = 1, .rows = elements, .width = h, .height = kWaveColumn}), c);
  const double period = 2.0 * kPi / w, rise = 4.0 * period;
  s.dt = period / std::ceil(period / s.dt);
  const double still = s.state.pressure[0];
  const std::int32_t top = s.model.dof.back()[1];
  Fourier displacement(w), pressure(w);
  const auto steps = static_cast<std::int64_t>(std::lround(8.0 * period / s.dt));
  const auto first = static_cast<std::int64_t>(std::lround(6.0 * period / s.dt));
  for (std::int64_t k = 0; k < steps; ++k) {
    for (const std::int32_t node : s.layout.nodes.back())
      if (s.model.mesh.nodes[node][1] > kWaveColumn - 1e-9)
        s.model.load[s.model.dof[node][1]] = 0.5 * h * 1e3 * gentle(w, s.state.time, rise);
    // both nodes of the surface are one unknown
    s.model.load[top] *= 2.0;
    advance(s, {});
    if (k < first) continue;
    displacement.add(s.state.time, s.state.displacement[top], s.dt);
    pressure.add(s.state.time, s.state.pressure[0] - still, s.dt);
  }
  return {displacement.amplitude() / 1e3, pressure.amplitude() / 1e3};
}

}  // namespace

std::vector<Check> verify_harmonic_column(std::string_view name) {
  CheckList checks(name);
  const double modulus = 10e6 * 0.75 / (1.25 * 0.5);
  struct Case {
    double frequency, permeability;
    int elements;
  };
  std::vector<double> errors;
  for (const Case& x : {Case{2.0, 1e-2, 80}, Case{2.0, 1e-3, 80}, Case{10.0, 1e-3, 160},
                        Case{30.0, 1e-2, 80}, Case{30.0, 1e-2, 160}}) {
    const double w = 2.0 * kPi * x.frequency;
    const Soil soil{modulus, 1900.0, (0.8 / 1.8) / 2.2e9, x.permeability / 9810.0};
    const Response exact = exact_column(soil, w);
    const Response found = computed_column(x.elements, x.permeability, w);
    errors.push_back(std::abs(found.base / exact.base - 1.0));
    // the boundary layer under the surface is 0.36 m thick at 30 Hz
    const double tolerance = x.frequency > 20.0 && x.elements < 100 ? 0.08 : 0.025;
    const auto label = fmt::format("{:g}_hz_{:g}_m_s_{}", x.frequency, x.permeability, x.elements);
    checks.near("top_" + label, found.top / exact.top, 1.0, tolerance);
    checks.near("base_" + label, found.base / exact.base, 1.0, tolerance);
  }
  // two in space, one in time
  checks.at_least("order", std::log2(errors[3] / errors[4]), 1.4);
  return checks.take();
}

namespace {

constexpr double kDensity = 1900.0, kShearVelocity = 200.0, kLayer = 20.0;
constexpr double kRockDensity = 2200.0, kRockVelocity = 760.0;

/// A dry column of soil of shear wave velocity 200 m/s.
Solver dry_column(double rock_velocity, double rock_density, double beta, int rows) {
  const double shear = kDensity * kShearVelocity * kShearVelocity;
  FemConfig c = config(elastic_soil(2.0 * 1.25 * shear, 0.25), 0.0);
  c.materials["soil"].density = kDensity;
  c.water.reset();
  if (rock_velocity > 0.0) {
    c.base.motion = BaseMotionKind::outcrop;
    c.base.shear_wave_velocity = rock_velocity;
    c.base.density = rock_density;
  }
  c.damping.stiffness = beta;
  const double h = kLayer / rows;
  return at_rest(section({.columns = 1, .rows = rows, .width = h, .height = kLayer}), c);
}

}  // namespace

std::vector<Check> verify_site_response(std::string_view name) {
  CheckList checks(name);
  const double f1 = kShearVelocity / (4.0 * kLayer);
  const double beta = 0.05 / (kPi * f1);
  for (const double ratio : {0.5, 1.0, 2.0, 3.0}) {
    const double w = 2.0 * kPi * ratio * f1, period = 2.0 * kPi / w;
    Solver s = dry_column(kRockVelocity, kRockDensity, beta, 30);
    s.dt = period / std::ceil(period / s.dt);
    const std::int32_t top = s.model.dof.back()[0];
    Fourier surface(w);
    const double end = std::ceil(3.0 / period) * period;
    while (s.state.time < end + 2.0 * period - 0.5 * s.dt) {
      advance(s, {gentle(w, s.state.time, 1.0), gentle(w, s.state.time + s.dt, 1.0)});
      if (s.state.time > end + 0.5 * s.dt)
        surface.add(s.state.time - 0.5 * s.dt, s.state.velocity[top], s.dt);
    }
    const Complex softened = 1.0 + kI * beta * w;
    const Complex velocity = kShearVelocity * std::sqrt(softened);
    const Complex angle = w * kLayer / velocity;
    const Complex impedance = kDensity * velocity / (kRockDensity * kRockVelocity);
    const double exact = 1.0 / std::abs(cos(angle) + kI * impedance * sin(angle));
    checks.near(fmt::format("amplification_at_{:g}_f1", ratio), surface.amplitude() / exact, 1.0,
                0.02);
  }
  return checks.take();
}

std::vector<Check> verify_reflection(std::string_view name) {
  CheckList checks(name);
  const auto remaining = [](double rock_velocity) {
    Solver s = dry_column(rock_velocity, kDensity, 0.0, 40);
    const double width = 0.05, centre = 0.2, transit = kLayer / kShearVelocity;
    const auto pulse = [&](double t) {
      const double x = (t - centre) / width;
      return t < 2.0 * centre ? (1.0 - 2.0 * x * x) * exp(-x * x) : 0.0;
    };
    double peak = 0.0, left = 0.0;
    const double clear = 2.0 * centre + 2.5 * transit;
    while (s.state.time < clear + 2.0 * transit) {
      advance(s, {pulse(s.state.time), pulse(s.state.time + s.dt)});
      for (std::int32_t u = 0; u < s.model.num_dofs; ++u) {
        double& highest = s.state.time > clear ? left : peak;
        highest = std::max(highest, std::abs(s.state.velocity[u]));
      }
    }
    return left / peak;
  };
  checks.at_most("compliant_base", remaining(kShearVelocity), 0.01);
  checks.at_least("rigid_base_control", remaining(0.0), 0.5);
  return checks.take();
}

}  // namespace flowslide::fem
