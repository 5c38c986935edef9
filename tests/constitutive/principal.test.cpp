#include "core/pack_pair.hpp"
#include "tests/constitutive/sample_laws.hpp"

#include <catch2/catch.hpp>

using namespace flowslide;

TEST_CASE("Three numbers are sorted without rounding", "[constitutive]") {
  double v[3] = {0.1, -7.0, 0.1 + 1e-16};
  std::sort(v, v + 3);
  const double lo = v[0], mid = v[1], hi = v[2];
  do {
    const Sorted3<double> s = sort3(v[0], v[1], v[2]);
    CHECK(s.lo == lo);
    CHECK(s.mid == mid);
    CHECK(s.hi == hi);
  } while (std::next_permutation(v, v + 3));
}

TEST_CASE("Principal stresses of three dimensions agree with Eigen, equal ones included",
          "[constitutive]") {
  std::mt19937_64 random(5);
  for (int i = 0; i < 3000; ++i) {
    auto s = random_voigt<Stress<3>>(random, 1.0);
    if (i % 3 == 1) s = {{2.0, 2.0, 2.0, 1e-9 * s[3], 1e-9 * s[4], 0.0}};
    if (i % 3 == 2) s = {{s[0], s[0], s[2], 0.0, 0.0, 0.0}};
    const Eigen3 e = eigen_symmetric(s);
    std::array<double, 3> v{e.value[0], e.value[1], e.value[2]};
    std::sort(v.begin(), v.end(), std::greater<>());
    const auto expected = principal(s);
    Eigen::Matrix3d rebuilt = Eigen::Matrix3d::Zero();
    for (int k = 0; k < 3; ++k) {
      CHECK(v[k] == Approx(expected[k]).margin(1e-13));
      const Eigen::Vector3d n(e.vector[k][0], e.vector[k][1], e.vector[k][2]);
      CHECK(n.norm() == Approx(1.0).epsilon(1e-13));
      rebuilt += e.value[k] * n * n.transpose();
    }
    CHECK((rebuilt - tensor(s)).norm() < 1e-13 * (1.0 + tensor(s).norm()));
  }
}

TEMPLATE_TEST_CASE("A map of principal stresses keeps axes and sees them in order",
                   "[constitutive]", Stress<2>, Stress<3>) {
  std::mt19937_64 random(6);
  for (int i = 0; i < 3000; ++i) {
    TestType s = random_voigt<TestType>(random, 1.0);
    if (i % 5 == 0) s[3] = 0.0;
    if (i % 7 == 0) s[1] = s[0];
    const TestType same = map_principal(s, [](const Sorted3<double>& t) {
      REQUIRE(t.hi >= t.mid);
      REQUIRE(t.mid >= t.lo);
      return t;
    });
    CHECK(distance(same, s) < 1e-13 * (1.0 + tensor(s).norm()));
    // An isotropic function with a known closed form: the square of the tensor, made positive.
    const Eigen::Matrix3d shifted = tensor(s) + 20.0 * Eigen::Matrix3d::Identity();
    const TestType square = map_principal(s, [](const Sorted3<double>& t) {
      const auto f = [](double x) { return (x + 20.0) * (x + 20.0); };
      return Sorted3<double>{f(t.hi), f(t.mid), f(t.lo)};
    });
    CHECK((tensor(square) - shifted * shifted).norm() < 1e-12 * (shifted * shifted).norm());
  }
}

TEST_CASE("Lanes of a 3D map are the points one by one, equal principal stresses included",
          "[constitutive]") {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> exponent(-9.0, 3.0);
  for (int i = 0; i < 2000; ++i) {
    std::array<Stress<3>, Pack::lanes> lane;
    Stress<3, Pack> s{};
    for (int k = 0; k < Pack::lanes; ++k) {
      lane[k] = random_voigt<Stress<3>>(random, 1e4);
      const double small = std::pow(10.0, exponent(random));
      if ((i + k) % 5 == 1) lane[k] = {{2.0, 2.0, 2.0, small, small, 0.0}};
      if ((i + k) % 5 == 2) lane[k] = {{lane[k][0], lane[k][0], lane[k][2], 0.0, 0.0, small}};
      if ((i + k) % 5 == 3) lane[k] = {};
      for (int c = 0; c < 6; ++c) s[c].v[k] = lane[k][c];
    }
    const auto cap = [](const auto& t) {
      using T = std::decay_t<decltype(t.hi)>;
      return Sorted3<T>{min(t.hi, T(1.0)), min(t.mid, T(1.0)), min(t.lo, T(1.0))};
    };
    const Stress<3, Pack> r = map_principal(s, cap);
    Stress<3, PackPair> pair;
    for (int c = 0; c < 6; ++c) pair[c] = {s[c], -s[c]};
    const Stress<3, PackPair> both = map_principal(pair, cap);
    for (int k = 0; k < Pack::lanes; ++k) {
      for (int c = 0; c < 6; ++c) REQUIRE(both[c].a[k] == r[c][k]);
      const Stress<3> one = map_principal(lane[k], cap);
      for (int c = 0; c < 6; ++c)
        REQUIRE(std::abs(r[c][k] - one[c]) < 1e-12 * (1.0 + tensor(lane[k]).norm()));
    }
  }
}
