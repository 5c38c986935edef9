#include "constitutive/point_driver.hpp"

#include "core/check.hpp"
#include "core/conventions.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Dense>

namespace flowslide {
namespace {

/// Voigt index of xx, yy, xy.
constexpr std::array<int, 3> kComponent{0, 1, 3};
constexpr int kMaxIterations = 60;
constexpr int kMaxHalvings = 8;

Eigen::Matrix3d elastic_matrix(const Elasticity& e) {
  const double a = e.bulk + 4.0 / 3.0 * e.shear, b = e.bulk - 2.0 / 3.0 * e.shear;
  Eigen::Matrix3d m;
  m << a, b, 0.0, b, a, 0.0, 0.0, 0.0, e.shear;
  return m;
}

/// Newton's matrix by forward differences: dsigma_i/deps_j over the free components.
Eigen::MatrixXd secant_matrix(const PointUnderTest& point, const StrainIncrement<2>& at,
                              const std::vector<int>& free) {
  const double h = 1e-8;
  const int n = static_cast<int>(free.size());
  Eigen::MatrixXd m(n, n);
  for (int j = 0; j < n; ++j) {
    StrainIncrement<2> up = at, down = at;
    up[free[j]] += h;
    down[free[j]] -= h;
    const Stress<2> a = point.trial(up), b = point.trial(down);
    for (int i = 0; i < n; ++i) m(i, j) = (a[free[i]] - b[free[i]]) / (2.0 * h);
  }
  return m;
}

/// Throws NumericsError for a prescribed stress that is missed by more than a tolerance [Pa].
void check_reached(double error, double tolerance) {
  if (!std::isfinite(error))
    throw NumericsError(
        "the prescribed stress leads to one that is not finite (the parameters or the stress are "
        "far from those of soil) check their units");
  if (!(error <= tolerance))
    throw NumericsError(fmt::format(
        "the prescribed stress is missed by {:.3g} Pa after {} iterations (the law cannot carry it "
        "at this state) prescribe a strain, or a stress inside the strength",
        error, kMaxIterations));
}

}  // namespace

StrainIncrement<2> mixed_step(PointUnderTest& point, const std::array<Prescribed, 3>& step,
                              double tolerance) {
  StrainIncrement<2> de;
  std::vector<int> free;
  std::vector<double> target;
  for (int k = 0; k < 3; ++k) {
    const Prescribed& wish = step[static_cast<std::size_t>(k)];
    const int i = kComponent[static_cast<std::size_t>(k)];
    if (wish.kind == Prescribed::Kind::strain) {
      de[i] = wish.value;
    } else {
      free.push_back(i);
      target.push_back(wish.value);
    }
  }
  const int n = static_cast<int>(free.size());
  const auto residual = [&](const StrainIncrement<2>& at) {
    const Stress<2> s = point.trial(at);
    Eigen::VectorXd r(n);
    for (int i = 0; i < n; ++i) r[i] = target[static_cast<std::size_t>(i)] - s[free[i]];
    return r;
  };
  double error = 0.0;
  if (n > 0) {
    const Eigen::Matrix3d full = elastic_matrix(point.elasticity());
    Eigen::MatrixXd elastic(n, n);
    const auto row = [](int voigt) { return std::min(voigt, 2); };
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j) elastic(i, j) = full(row(free[i]), row(free[j]));
    Eigen::VectorXd r = residual(de);
    error = r.cwiseAbs().maxCoeff();
    // No step leads back from a stress that is not finite.
    for (int k = 0; k < kMaxIterations && error > tolerance && std::isfinite(error); ++k) {
      const Eigen::MatrixXd m = k < 2 ? elastic : secant_matrix(point, de, free);
      const Eigen::VectorXd full_step = m.fullPivLu().solve(r);
      // halve until the residual falls: the law is stiffer unloading than loading
      for (double part = 1.0; part > 1e-3; part *= 0.5) {
        StrainIncrement<2> next = de;
        for (int i = 0; i < n; ++i) next[free[i]] += part * full_step[i];
        const Eigen::VectorXd r_next = residual(next);
        const double e_next = r_next.cwiseAbs().maxCoeff();
        if (e_next < error || part < 2e-3) {
          de = next;
          r = r_next;
          error = e_next;
          break;
        }
      }
    }
  }
  check_reached(error, tolerance);
  point.stress = point.advance(de);
  return de;
}

namespace {

/// The first half of a step from the present stress.
std::array<Prescribed, 3> first_half(const PointUnderTest& point, std::array<Prescribed, 3> step) {
  for (std::size_t k = 0; k < 3; ++k) {
    const bool strain = step[k].kind == Prescribed::Kind::strain;
    step[k].value = 0.5 * (step[k].value + (strain ? 0.0 : point.stress[kComponent[k]]));
  }
  return step;
}

StrainIncrement<2> divided_step(PointUnderTest& point, const std::array<Prescribed, 3>& step,
                                double tolerance, int halvings) {
  try {
    return mixed_step(point, step, tolerance);
  } catch (const NumericsError&) {
    if (halvings == kMaxHalvings) throw;
  }
  const std::array<Prescribed, 3> half = first_half(point, step);
  StrainIncrement<2> de = divided_step(point, half, tolerance, halvings + 1);
  std::array<Prescribed, 3> rest = step;
  for (Prescribed& p : rest)
    if (p.kind == Prescribed::Kind::strain) p.value *= 0.5;
  const StrainIncrement<2> second = divided_step(point, rest, tolerance, halvings + 1);
  for (int i = 0; i < 4; ++i) de[i] += second[i];
  return de;
}

}  // namespace

StrainIncrement<2> divided_step(PointUnderTest& point, const std::array<Prescribed, 3>& step,
                                double tolerance) {
  return divided_step(point, step, tolerance, 0);
}

ShearTest run_simple_shear(PointUnderTest& point, const SimpleShear& test) {
  validate(
      test.strain_step > 0.0 && test.stop_strain > 0.0,
      "simple shear: strain_step {} and stop_strain {} (both must be above zero) give positive "
      "numbers",
      test.strain_step, test.stop_strain);
  validate(test.reversal_stress.value_or(1.0) > 0.0 && test.reversal_strain.value_or(1.0) > 0.0,
           "simple shear: a reversal stress or strain is not above zero (the test would turn at "
           "every step) give a positive one");
  const double vertical = point.stress[1];
  // sub-steps that come and go make a law's stress jump by about 1e-6 of itself
  const double tolerance = 1e-5 * std::abs(vertical);
  ShearTest r{{{0.0, point.stress[0], vertical, point.stress[3], 0.0, 0}}, ShearEnd::half_cycles};
  ShearRecord now = r.records.front();
  double direction = 1.0;
  while (now.half_cycles < test.max_half_cycles) {
    validate(r.records.size() <= test.max_steps,
             "simple_shear: {} steps, and the test is at cycle {} of {} (each step is kept) raise "
             "strain_step, or lower max_cycles",
             test.max_steps, 0.5 * now.half_cycles, 0.5 * test.max_half_cycles);
    const double d_gamma = direction * test.strain_step;
    const auto normal = test.drained ? Prescribed::stress_value(vertical) : Prescribed{};
    const StrainIncrement<2> de = divided_step(
        point, {Prescribed{}, normal, Prescribed::strain_increment(d_gamma)}, tolerance);
    now.gamma += d_gamma;
    now.eps_yy += de[1];
    now.sigma_xx = point.stress[0];
    now.sigma_yy = point.stress[1];
    now.tau = point.stress[3];
    if (!std::isfinite(now.tau + now.sigma_yy + now.sigma_xx))
      throw NumericsError(
          fmt::format("simple shear: the stress is not finite at step {}, gamma = {:.4g} (the "
                      "parameters or the stress at the start are far from those of soil) check "
                      "their units",
                      r.records.size(), now.gamma));
    const bool stress_turns = test.reversal_stress && direction * now.tau >= *test.reversal_stress;
    const double forward = direction * now.gamma * (1.0 + kSumSlack);
    const bool strain_turns = test.reversal_strain && forward >= *test.reversal_strain;
    r.records.push_back(now);
    if (forward >= test.stop_strain && !strain_turns) {
      r.end = ShearEnd::stop_strain;
      return r;
    }
    if (stress_turns || strain_turns) {
      direction = -direction;
      ++now.half_cycles;
    }
  }
  return r;
}

double pore_pressure_ratio(const ShearTest& test, std::size_t record) {
  return 1.0 - test.records.at(record).sigma_yy / test.records.front().sigma_yy;
}

Loop last_loop(const ShearTest& test) {
  const int turns = test.records.back().half_cycles;
  validate(turns >= 2,
           "simple shear: {} complete half cycles (a loop needs three) raise max_half_cycles",
           turns + 1);
  // the last record of each half cycle is a turning point
  std::vector<std::size_t> turning;
  for (std::size_t i = 1; i < test.records.size(); ++i)
    if (test.records[i].half_cycles != test.records[i - 1].half_cycles) turning.push_back(i - 1);
  turning.push_back(test.records.size() - 1);
  const std::size_t first = turning[turning.size() - 3], middle = turning[turning.size() - 2],
                    last = turning.back();
  const auto& r = test.records;
  double area = 0.0;
  for (std::size_t i = first; i < last; ++i)
    area += 0.5 * (r[i].tau + r[i + 1].tau) * (r[i + 1].gamma - r[i].gamma);
  const double d_gamma = 0.5 * std::abs(r[last].gamma - r[middle].gamma);
  const double d_tau = 0.5 * std::abs(r[last].tau - r[middle].tau);
  return {d_tau / d_gamma, std::abs(area) / (2.0 * kPi * d_tau * d_gamma)};
}

}  // namespace flowslide
