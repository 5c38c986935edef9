#include "tests/constitutive/sample_laws.hpp"

#include <catch2/catch.hpp>

using namespace flowslide;

namespace {

/// Where a stress comes to lie on some of the planes of {N s <= b}: fixed * t + moved.
struct OnPlanes {
  Eigen::Matrix3d fixed;
  Eigen::Vector3d moved;
};

/// The closest points in the norm of D^-1 on every set of up to three planes.
std::vector<OnPlanes> sets_of_planes(const Eigen::MatrixX3d& n, const Eigen::VectorXd& b,
                                     const Eigen::Matrix3d& d) {
  const auto rows = static_cast<int>(n.rows());
  std::vector<OnPlanes> sets;
  const auto add = [&](const std::vector<int>& active) {
    Eigen::MatrixX3d a(active.size(), 3);
    Eigen::VectorXd rhs(active.size());
    for (std::size_t r = 0; r < active.size(); ++r)
      a.row(r) = n.row(active[r]), rhs[r] = b[active[r]];
    const Eigen::FullPivLU<Eigen::MatrixXd> lu(a * d * a.transpose());
    if (!lu.isInvertible()) return;
    const Eigen::MatrixXd back = d * a.transpose() * lu.inverse();
    sets.push_back({Eigen::Matrix3d::Identity() - back * a, back * rhs});
  };
  for (int i = 0; i < rows; ++i) {
    add({i});
    for (int j = i + 1; j < rows; ++j) {
      add({i, j});
      for (int k = j + 1; k < rows; ++k) add({i, j, k});
    }
  }
  return sets;
}

/// Closest point of {N s <= b} to t in the norm of D^-1, by trying every set of active planes:
/// slow, and nothing in common with the closed forms under test.
Eigen::Vector3d closest_point(const Eigen::MatrixX3d& n, const Eigen::VectorXd& b,
                              const Eigen::Matrix3d& d, const std::vector<OnPlanes>& sets,
                              const Eigen::Vector3d& t) {
  const Eigen::Matrix3d inverse = d.inverse();
  const double tolerance = 1e-9 * (t.norm() + b.cwiseAbs().minCoeff());
  double best = 1e300;
  Eigen::Vector3d closest = t;
  const auto consider = [&](const Eigen::Vector3d& s) {
    if ((n * s - b).maxCoeff() > tolerance) return;
    const double distance = (t - s).dot(inverse * (t - s));
    if (distance < best) best = distance, closest = s;
  };
  consider(t);
  for (const OnPlanes& set : sets) consider(set.fixed * t + set.moved);
  return closest;
}

}  // namespace

TEST_CASE("With psi = phi the return is the closest point in the elastic energy norm",
          "[constitutive]") {
  const auto [phi, cutoff] = GENERATE(std::pair{30.0, -1.0}, std::pair{30.0, 3e3},
                                      std::pair{40.0, 0.0}, std::pair{0.0, -1.0});
  MohrCoulomb::Params p = sample_params<MohrCoulomb>();
  p.friction_angle = p.dilation_angle = phi * kDegree;
  if (cutoff >= 0.0) p.tension_cutoff = cutoff;
  const MohrCoulomb::Constants c = MohrCoulomb::constants(p, 1.0);
  const MohrCoulombSurface<double> y = MohrCoulomb::surface(c, MohrCoulomb::State{});

  // Six shear planes and three tension planes: no order of the principal stresses is assumed.
  Eigen::MatrixX3d n(9, 3);
  Eigen::VectorXd b(9);
  n.setZero();
  for (int i = 0, r = 0; i < 3; ++i) {
    n(6 + i, i) = 1.0;
    b[6 + i] = y.tension;
    for (int j = 0; j < 3; ++j) {
      if (j == i) continue;
      n(r, i) = y.k;
      n(r, j) = -1.0;
      b[r++] = y.sigma_c;
    }
  }
  const double lambda = c.elastic.bulk - 2.0 / 3.0 * c.elastic.shear;
  const Eigen::Matrix3d d =
      lambda * Eigen::Matrix3d::Ones() + 2.0 * c.elastic.shear * Eigen::Matrix3d::Identity();

  const std::vector<OnPlanes> sets = sets_of_planes(n, b, d);

  std::mt19937_64 random(10);
  std::normal_distribution<double> normal(0.0, 30e3);
  std::uniform_real_distribution<double> level(-60e3, 60e3);
  double worst = 0.0;
  for (int i = 0; i < 1500; ++i) {
    const double mean = level(random);
    double t[3] = {mean + normal(random), mean + normal(random), mean + normal(random)};
    if (i % 10 == 0) t[1] = t[0];
    std::sort(t, t + 3, std::greater<>());
    const Principal<double> s =
        return_to_mohr_coulomb(c.elastic, y, Principal<double>{t[0], t[1], t[2]});
    const Eigen::Vector3d expected = closest_point(n, b, d, sets, {t[0], t[1], t[2]});
    worst = std::max(worst, (Eigen::Vector3d(s.s1, s.s2, s.s3) - expected).norm());
  }
  CHECK(worst < 1e-3);  // [Pa] of some 1e5: the constraints' tolerance above
}
