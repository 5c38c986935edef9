#include "mpm/momentum.hpp"
#include "tests/mpm/scene.hpp"

#include <catch2/catch.hpp>

using namespace flowslide;
using namespace flowslide::mpm;

TEST_CASE("The ground is a polyline, level beyond its ends", "[mpm]") {
  const Ground g{{0.0, 10.0, 10.0, 20.0}, {0.0, 5.0, 1.0, 1.0}, 0.5};
  CHECK(g.level(-3.0) == 0.0);
  CHECK(g.level(4.0) == Approx(2.0));
  CHECK(g.level(10.0 - 1e-9) == Approx(5.0));
  CHECK(g.level(10.0 + 1e-9) == Approx(1.0));
  CHECK(g.level(99.0) == 1.0);
  CHECK(g.slope(4.0) == Approx(0.5));
  CHECK(g.slope(15.0) == 0.0);
  CHECK(g.slope(-1.0) == 0.0);
}

TEST_CASE("A node on the ground is pushed but not pulled, and rubbed by Coulomb", "[mpm]") {
  const BoundaryNode<2> ground{0, 0, {0.0, 1.0}, 0.5};
  using V = std::array<double, 2>;
  CHECK(constrained<2>(ground, V{3.0, 1.0}) == V{3.0, 1.0});   // leaves
  CHECK(constrained<2>(ground, V{3.0, -2.0}) == V{2.0, 0.0});  // slides: loses mu v_n
  CHECK(constrained<2>(ground, V{-3.0, -2.0}) == V{-2.0, 0.0});
  CHECK(constrained<2>(ground, V{0.9, -2.0}) == V{0.0, 0.0});  // sticks
  const BoundaryNode<2> wall{0, 1, {1.0, 0.0}, 0.0};
  CHECK(constrained<2>(wall, V{3.0, -2.0}) == V{0.0, -2.0});
  CHECK(constrained<2>(wall, V{-3.0, -2.0}) == V{0.0, -2.0});
  const double r = std::sqrt(0.5);
  const BoundaryNode<2> slope{0, 0, {-r, r}, 0.0};
  const V along = constrained<2>(slope, V{1.0, 0.0});  // up a slope of 45 degrees
  CHECK(along[0] == Approx(0.5));
  CHECK(along[1] == Approx(0.5));
}

TEST_CASE("Boundary nodes are those at or below the ground and behind the walls", "[mpm]") {
  ParticleSet p;
  p.materials = {elastic(1e6, 0.3)};
  add_lattice(p, {0.0, 0.0, 6.0, 3.0}, 0.25, 1000.0);
  FlowConfig config = free_space(0.5);
  config.ground.surface = {{0.0, 0.0}, {6.0, 1.5}};
  config.left_roller = 0.0;
  for (auto& x : p.position) x[1] += 1.5;
  const Run run(p, config);
  const Grid<2>& g = run.s.grid;
  REQUIRE(g.boundary_first.size() == g.blocks.size() + 1);
  int walls = 0, grounds = 0;
  for (std::size_t b = 0; b < g.blocks.size(); ++b) {
    std::vector<int> kinds(kBlockNodes<2>, 0);
    for (std::int32_t k = g.boundary_first[b]; k < g.boundary_first[b + 1]; ++k)
      kinds[g.boundary[k].local] |= g.boundary[k].kind == 1 ? 1 : 2;
    for (int n = 0; n < kBlockNodes<2>; ++n) {
      const double x = 0.5 * (g.blocks[b][0] * 8 + n % 8), y = 0.5 * (g.blocks[b][1] * 8 + n / 8);
      const double level = std::min(1.5, std::max(0.0, 0.25 * x));
      const int expected = (x <= 1e-9 ? 1 : 0) + (y <= level + 1e-9 ? 2 : 0);
      REQUIRE(kinds[n] == expected);
      walls += (expected & 1) != 0;
      grounds += (expected & 2) != 0;
    }
  }
  CHECK(walls > 10);
  CHECK(grounds > 10);
}
