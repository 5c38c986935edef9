#include "motion/process.hpp"

#include "core/conventions.hpp"
#include "motion/measures.hpp"

#include <algorithm>

#include <Eigen/Dense>

namespace flowslide {

GroundMotion scaled_to_pga(const GroundMotion& motion, double target) {
  check(motion);
  validate(target > 0.0 && std::isfinite(target),
           "a peak acceleration of {} m/s2 cannot be scaled to (it must be positive)", target);
  const double before = pga(motion);
  GroundMotion scaled = motion;
  for (double& a : scaled.acceleration)
    a = std::abs(a) == before ? std::copysign(target, a) : a * (target / before);
  scaled.origin +=
      fmt::format("; scaled by {:.4g} to {:.4g} g", target / before, target / kGravity);
  return scaled;
}

GroundMotion baseline_corrected(const GroundMotion& motion, int degree, BaselineFit fit) {
  constexpr int kHighest = 8;  // more would follow the shaking itself
  check(motion);
  validate(degree >= 0 && degree <= kHighest, "a baseline of degree {} is not between 0 and {}",
           degree, kHighest);
  const auto n = static_cast<Eigen::Index>(motion.acceleration.size());
  validate(n > degree + 1, "{}: {} samples (too few for a baseline of degree {})", motion.origin,
           motion.acceleration.size(), degree);
  const bool to_velocity = fit == BaselineFit::velocity;
  const std::vector<double> y = to_velocity ? velocity(motion) : motion.acceleration;
  const Eigen::VectorXd s = Eigen::VectorXd::LinSpaced(n, 0.0, 1.0);  // time / duration

  // Columns s^0 .. s^degree, or s^1 .. s^(degree + 1) for a velocity that starts at zero.
  Eigen::MatrixXd powers(n, degree + 1);
  powers.col(0) = to_velocity ? s : Eigen::VectorXd::Ones(n);
  for (int k = 1; k <= degree; ++k) powers.col(k) = powers.col(k - 1).cwiseProduct(s);
  const Eigen::VectorXd c =
      powers.colPivHouseholderQr().solve(Eigen::Map<const Eigen::VectorXd>(y.data(), n));

  GroundMotion corrected = motion;
  for (Eigen::Index i = 0; i < n; ++i) {
    double baseline = 0.0;
    for (int k = degree; k >= 0; --k)
      baseline = baseline * s[i] + (to_velocity ? c[k] * (k + 1) / motion.duration() : c[k]);
    corrected.acceleration[static_cast<std::size_t>(i)] -= baseline;
  }
  corrected.origin += fmt::format("; baseline of degree {} fitted to {} removed", degree,
                                  kBaselineFits[static_cast<std::size_t>(fit)]);
  return corrected;
}

}  // namespace flowslide
