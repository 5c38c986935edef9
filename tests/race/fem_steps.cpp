#include "fem/implicit.hpp"
#include "verify/fem/scene.hpp"

#include <catch2/catch.hpp>
#include <omp.h>

/// Explicit and implicit steps over more pieces of work than threads.
using namespace flowslide;
using namespace flowslide::fem;

namespace {

double ground(double t) { return 0.15 * std::sin(2.0 * kPi * 1.5 * t); }

Solver dam(const FemMaterialConfig& material) {
  omp_set_num_threads(4);
  FemConfig c = config(material, 4.0);
  c.base = {BaseMotionKind::outcrop, 400.0, 2000.0, true};
  c.sides.kind = SideKind::free_field;
  c.damping.mass = 0.5;
  c.damping.stiffness = 1e-3;
  return at_rest(section({.columns = 16, .rows = 16, .distortion = 0.1}), c);
}

}  // namespace

TEST_CASE("Explicit steps of sand and water") {
  Solver s = dam(sand());
  REQUIRE(s.layout.elements.size() > 4 * std::size_t(kChunk));
  for (int i = 0; i < 20; ++i) advance(s, {ground(s.state.time), ground(s.state.time + s.dt)});
  refresh_moduli(s);
  CHECK(s.state.step == 20);
}

TEST_CASE("Implicit steps of sand and water") {
  Solver s = dam(sand());
  ImplicitRecord record;
  ImplicitSteps steps(s, {.step = 5e-3, .tolerance = 1e-6});
  for (int i = 0; i < 4; ++i) steps.advance(s, record, 1.0, ground);
  CHECK(record.iterations > 0);
}
