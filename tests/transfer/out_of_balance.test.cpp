#include "transfer/audit/out_of_balance.hpp"

#include "core/conventions.hpp"

#include <catch2/catch.hpp>

using namespace flowslide;

namespace {

/// 2 x 2 points per cell of 1 m on 10 m x 8 m, shifted by (sx, sy) cells, stress factor * gamma z.
ParticleSet column(double factor, double density, double sx, double sy) {
  ParticleSet p;
  const double gamma = density * kGravity;
  for (int j = 0; j < 16; ++j) {
    for (int i = 0; i < 20; ++i) {
      const double x = 0.5 * i + 0.25 + sx, y = 0.5 * j + 0.25 + sy;
      const double s = factor * gamma * (y - 8.0 - sy);
      p.position.push_back({x, y, 0.0});
      p.stress.push_back({0.5 * s, s, 0.5 * s, 0.0, 0.0, 0.0});
      p.mass.push_back(0.25 * density);
      p.volume.push_back(0.25);
    }
  }
  return p;
}

}  // namespace

TEST_CASE("Geostatic stress on the lattice is in balance at every interior node", "[transfer]") {
  const OutOfBalance o = out_of_balance(column(1.0, 1800.0, 0.0, 0.0), 1.0, {0.0, 0.0});
  CHECK(o.nodes == 7 * 5);
  CHECK(o.max < 1e-12);
  const OutOfBalance moved = out_of_balance(column(1.0, 1800.0, 0.3, -7.7), 1.0, {0.3, -7.7});
  CHECK(moved.nodes == 7 * 5);
  CHECK(moved.max < 1e-11);
}

TEST_CASE("Stress that carries nine tenths of the weight lets it fall with a tenth of g",
          "[transfer]") {
  const OutOfBalance o = out_of_balance(column(0.9, 1800.0, 0.0, 0.0), 1.0, {0.0, 0.0});
  CHECK(o.rms == Approx(0.1).epsilon(1e-10));
  CHECK(o.max == Approx(0.1).epsilon(1e-10));
}

TEST_CASE("Without interior nodes nothing is claimed", "[transfer]") {
  CHECK(out_of_balance(ParticleSet{}, 1.0, {}).nodes == 0);
  CHECK(out_of_balance(column(1.0, 1800.0, 0.0, 0.0), 5.0, {}).nodes == 0);
}
