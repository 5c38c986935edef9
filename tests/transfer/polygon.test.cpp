#include "transfer/seeding/polygon.hpp"

#include <catch2/catch.hpp>

using namespace flowslide;

TEST_CASE("Clipped halves of a polygon tile it", "[transfer]") {
  Polygon p;
  for (const Vec2 v : {Vec2{1000.1, 0.2}, Vec2{1003.3, 0.7}, Vec2{1002.6, 2.9}, Vec2{1000.4, 2.2}})
    p.push(v);
  const AreaMoment whole = area_moment(p);
  for (const int axis : {0, 1}) {
    const double bound = axis == 0 ? 1001.7 : 1.3;
    const AreaMoment a = area_moment(clip(p, axis, bound, Side::below));
    const AreaMoment b = area_moment(clip(p, axis, bound, Side::above));
    CHECK(a.area > 0.0);
    CHECK(b.area > 0.0);
    CHECK(a.area + b.area == Approx(whole.area).epsilon(1e-12));
    for (int i = 0; i < 2; ++i)
      CHECK((a.area * a.centroid[i] + b.area * b.centroid[i]) / whole.area ==
            Approx(whole.centroid[i]).epsilon(1e-12));
  }
}

TEST_CASE("A square clipped by a box has the area of the overlap", "[transfer]") {
  Polygon p;
  for (const Vec2 v : {Vec2{0.0, 0.0}, Vec2{2.0, 0.0}, Vec2{2.0, 2.0}, Vec2{0.0, 2.0}}) p.push(v);
  const AreaMoment part = area_moment(clip(p, Box{1.5, 9.0, -1.0, 0.5}));
  CHECK(part.area == 0.25);
  CHECK(part.centroid == Vec2{1.75, 0.25});
  CHECK(clip(p, Box{2.0, 3.0, 0.0, 2.0}).size == 0);
  CHECK(clip(p, Box{5.0, 6.0, 0.0, 2.0}).size == 0);
}

TEST_CASE("Quadrilaterals split into convex parts or are called folded", "[transfer]") {
  CHECK(convex_parts({Vec2{0, 0}, Vec2{1, 0}, Vec2{1, 1}, Vec2{0, 1}}).count == 1);
  const ConvexParts dart = convex_parts({Vec2{0, 0}, Vec2{4, 0}, Vec2{1, 1}, Vec2{0, 4}});
  REQUIRE(dart.count == 2);
  CHECK(area_moment(dart.part[0]).area + area_moment(dart.part[1]).area == 4.0);
  CHECK(convex_parts({Vec2{0, 0}, Vec2{1, 1}, Vec2{1, 0}, Vec2{0, 1}}).count == 0);
  CHECK(convex_parts({Vec2{0, 0}, Vec2{0, 1}, Vec2{1, 1}, Vec2{1, 0}}).count == 0);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  CHECK(convex_parts({Vec2{0, 0}, Vec2{1, nan}, Vec2{1, 1}, Vec2{0, 1}}).count == 0);
}
