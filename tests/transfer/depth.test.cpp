#include "transfer/zone/depth.hpp"

#include <catch2/catch.hpp>

using namespace flowslide;

TEST_CASE("depth is read at the lowest liquefied node of the window", "[transfer]") {
  const std::vector<Vec2> positions{{-60, 29}, {-60, 14},  {-60, 5},
                                    {-50, 8},  {-49.9, 2}, {-30, 11}};
  const std::vector<double> r_u{kUnset, 0.8, 0.7, 0.71, 0.9, 0.9};
  CHECK(depth_of_liquefaction({-70, -50}, 30.0, positions, r_u, 0.7) == 22.0);
  CHECK(depth_of_liquefaction({-40, -20}, 30.0, positions, r_u, 0.7) == 19.0);
  CHECK(depth_of_liquefaction({-40, -20}, 30.0, positions, r_u, 0.9) == 0.0);
  CHECK(depth_of_liquefaction({0, 20}, 30.0, positions, r_u, 0.7) == 0.0);
}

TEST_CASE("a node above the pond surface has no depth", "[transfer]") {
  CHECK(depth_of_liquefaction({0, 1}, 30.0, std::vector<Vec2>{{0.5, 31.0}},
                              std::vector<double>{1.0}, 0.7) == 0.0);
}
