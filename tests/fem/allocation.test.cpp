#include "fem/implicit.hpp"
#include "tests/support/count_allocations.hpp"
#include "verify/fem/scene.hpp"

#include <cmath>

#include <catch2/catch.hpp>
#include <omp.h>

using namespace flowslide;
using namespace flowslide::fem;
using test::allocations;

#if FLOWSLIDE_COUNTS_ALLOCATIONS

namespace {

double ground(double t) { return 0.05 * std::sin(2.0 * kPi * t); }

Solver section_at_rest() {
  omp_set_num_threads(1);
  return at_rest(section({.columns = 4, .rows = 4, .distortion = 0.1}), config(sand(), 2.0));
}

struct Count {
  long allocations = 0;
  std::int64_t iterations = 0;
};

/// Of one step, after steps in which all buffers have found their size.
Count implicit_step(double tolerance) {
  Solver s = section_at_rest();
  ImplicitRecord record;
  ImplicitSteps steps(s, {.step = 5e-3, .tolerance = tolerance, .max_iterations = 200});
  const std::function<double(double)> motion = ground;
  for (int i = 0; i < 20; ++i) steps.advance(s, record, 1.0, motion);
  const std::int64_t iterations = record.iterations;
  const long before = allocations;
  steps.advance(s, record, 1.0, motion);
  REQUIRE(record.cut == 0);  // a halved step has another matrix
  return {allocations - before, record.iterations - iterations};
}

}  // namespace

TEST_CASE("An explicit step of shaking allocates nothing", "[fem]") {
  Solver s = section_at_rest();
  const auto step = [&] { advance(s, {ground(s.state.time), ground(s.state.time + s.dt)}); };
  for (int i = 0; i < 5; ++i) step();
  const long before = allocations;
  for (int i = 0; i < 20; ++i) step();
  CHECK(allocations - before == 0);
}

TEST_CASE("An implicit step allocates for its matrix, not for its iterations", "[fem]") {
  const Count loose = implicit_step(1e-2), tight = implicit_step(1e-7);
  CHECK(tight.iterations > loose.iterations + 2);
  CHECK(tight.allocations == loose.allocations);
}

#endif
