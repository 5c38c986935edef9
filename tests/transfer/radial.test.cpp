#include "transfer/sordo2024/radial.hpp"

#include "core/check.hpp"

#include <cmath>
#include <cstring>

#include <catch2/catch.hpp>

using namespace flowslide;
using Catch::Matchers::Contains;

namespace {

/// Points of the R2 sequence (golden-ratio lattice): scattered, never coincident.
std::vector<Vec2> scattered(std::size_t n, double width, double height) {
  std::vector<Vec2> x;
  for (std::size_t i = 1; i <= n; ++i) {
    const auto k = static_cast<double>(i);
    x.push_back({width * std::fmod(k * 0.7548776662466927, 1.0),
                 height * std::fmod(k * 0.5698402909980532, 1.0)});
  }
  return x;
}

Eigen::MatrixXd smooth_field(const std::vector<Vec2>& x) {
  Eigen::MatrixXd f(static_cast<Eigen::Index>(x.size()), 2);
  for (Eigen::Index i = 0; i < f.rows(); ++i)
    f.row(i) << std::sin(x[i][0]) + x[i][1], std::cos(x[i][0] * x[i][1]);
  return f;
}

}  // namespace

TEST_CASE("the multiquadric through two centres is the one solved by hand") {
  // One edge of the bounding box has length 1, the other 0: epsilon = 1/2, phi(1) = sqrt(5).
  // f = (1, 0) at the centres gives w = (-1, sqrt 5)/4, and phi(1/2) = sqrt 2 half way.
  const std::vector<Vec2> centres{{0, 3}, {1, 3}};
  CHECK(multiquadric_epsilon(centres) == 0.5);
  const Eigen::MatrixXd f =
      interpolate_multiquadric(centres, Eigen::Vector2d(1.0, 0.0), {{0.5, 3.0}, {0.0, 3.0}});
  CHECK(f(0, 0) == Approx(std::sqrt(2.0) * (std::sqrt(5.0) - 1.0) / 4.0).epsilon(1e-14));
  CHECK(f(1, 0) == Approx(1.0).epsilon(1e-14));
}

TEST_CASE("epsilon is the mean spacing of the centres in their bounding box") {
  CHECK(multiquadric_epsilon({{0, 0}, {4, 0}, {0, 9}, {4, 9}}) == Approx(3.0));
  CHECK_THROWS_WITH(multiquadric_epsilon({{1, 1}, {1, 1}}), Contains("one point"));
}

TEST_CASE("a smooth field is met at the centres and approached between them") {
  const std::vector<Vec2> targets{{0.7, 1.1}, {1.3, 0.6}};
  const Eigen::MatrixXd exact = smooth_field(targets);
  double coarse = 0.0;
  for (const std::size_t n : {50u, 400u}) {
    const std::vector<Vec2> centres = scattered(n, 2.0, 2.0);
    const Eigen::MatrixXd values = smooth_field(centres);
    const Eigen::MatrixXd back = interpolate_multiquadric(centres, values, centres);
    CHECK((back - values).cwiseAbs().maxCoeff() < 1e-9);
    const double error =
        (interpolate_multiquadric(centres, values, targets) - exact).cwiseAbs().maxCoeff();
    if (n == 50u) coarse = error;
    if (n == 400u) CHECK(error < 0.2 * coarse);
  }
}

TEST_CASE("the interpolation has the same bits for any number of threads") {
  const std::vector<Vec2> centres = scattered(300, 40.0, 10.0);
  const Eigen::MatrixXd values = smooth_field(centres);
  const std::vector<Vec2> targets = scattered(100, 30.0, 9.0);
  const int before = Eigen::nbThreads();
  Eigen::setNbThreads(1);
  const Eigen::MatrixXd one = interpolate_multiquadric(centres, values, targets);
  Eigen::setNbThreads(3);
  const int asked = Eigen::nbThreads();
  const Eigen::MatrixXd three = interpolate_multiquadric(centres, values, targets);
  CHECK(Eigen::nbThreads() == asked);
  Eigen::setNbThreads(before);
  CHECK(std::memcmp(one.data(), three.data(), sizeof(double) * one.size()) == 0);
}

TEST_CASE("centres and values that spoil the interpolation are refused") {
  std::vector<Vec2> centres = scattered(20, 1.0, 1.0);
  Eigen::MatrixXd values = smooth_field(centres);
  centres[7] = centres[3];
  CHECK_THROWS_AS(interpolate_multiquadric(centres, values, centres), NumericsError);
  values(4, 1) = kUnset;
  CHECK_THROWS_WITH(interpolate_multiquadric(scattered(20, 1.0, 1.0), values, centres),
                    Contains("not finite"));
  const std::vector<Vec2> many(20001, Vec2{0.0, 0.0});
  CHECK_THROWS_WITH(interpolate_multiquadric(many, Eigen::MatrixXd::Zero(20001, 1), centres),
                    Contains("too many"));
}
