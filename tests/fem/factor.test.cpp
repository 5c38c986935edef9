#include "fem/factor.hpp"

#include "core/check.hpp"

#include <catch2/catch.hpp>

using namespace flowslide;
using fem::BandFactor;

namespace {

/// Laplacian of a grid plus a shift; symmetric positive definite for a positive shift.
Eigen::SparseMatrix<double> grid(int nx, int ny, double shift) {
  std::vector<Eigen::Triplet<double>> t;
  const auto at = [&](int i, int j) { return j * nx + i; };
  const auto link = [&](int a, int b) {
    t.emplace_back(a, a, 1.0);
    t.emplace_back(b, b, 1.0);
    t.emplace_back(a, b, -1.0);
    t.emplace_back(b, a, -1.0);
  };
  for (int j = 0; j < ny; ++j)
    for (int i = 0; i < nx; ++i) {
      t.emplace_back(at(i, j), at(i, j), shift);
      if (i + 1 < nx) link(at(i, j), at(i + 1, j));
      if (j + 1 < ny) link(at(i, j), at(i, j + 1));
    }
  Eigen::SparseMatrix<double> m(nx * ny, nx * ny);
  m.setFromTriplets(t.begin(), t.end());
  return m;
}

}  // namespace

TEST_CASE("The band factor solves what the matrix multiplies", "[fem]") {
  const auto m = grid(40, 7, 0.01);
  BandFactor f(m);
  CHECK(f.bandwidth() <= 9);
  f.factorise(m);
  const Eigen::VectorXd x = Eigen::VectorXd::LinSpaced(m.rows(), -1.0, 3.0);
  Eigen::VectorXd b = m * x;
  f.solve(b.data());
  CHECK((b - x).norm() < 1e-10 * x.norm());
}

TEST_CASE("The band factor solves systems of any size and width", "[fem]") {
  // fewer rows than a block, a band narrower and wider than one, and a last block that is not full
  const auto [nx, ny] = GENERATE(
      table<int, int>({{1, 1}, {3, 1}, {8, 1}, {9, 1}, {17, 2}, {7, 7}, {13, 11}, {5, 31}}));
  CAPTURE(nx, ny);
  const auto m = grid(nx, ny, 0.1);
  BandFactor f(m);
  f.factorise(m);
  const Eigen::VectorXd x = Eigen::VectorXd::LinSpaced(m.rows(), -1.0, 3.0);
  for (int again = 0; again < 2; ++again) {
    Eigen::VectorXd b = m * x;
    f.solve(b.data());
    CHECK((b - x).norm() < 1e-12 * x.norm());
  }
}

TEST_CASE("The band factor copes with separate parts and refuses a singular matrix", "[fem]") {
  Eigen::SparseMatrix<double> two(6, 6);
  two.insert(0, 0) = 2.0;
  two.insert(0, 3) = two.insert(3, 0) = 1.0;
  two.insert(3, 3) = 2.0;
  for (const int i : {1, 2, 4, 5}) two.insert(i, i) = 4.0;
  BandFactor f(two);
  f.factorise(two);
  std::vector<double> b{3.0, 4.0, 8.0, 3.0, 12.0, 16.0};
  f.solve(b.data());
  const std::vector<double> exact{1.0, 1.0, 2.0, 1.0, 3.0, 4.0};
  for (int i = 0; i < 6; ++i) CHECK(b[i] == Approx(exact[i]).epsilon(1e-14));

  const auto singular = grid(5, 4, 0.0);
  BandFactor g(singular);
  CHECK_THROWS_AS(g.factorise(singular), NumericsError);
}
