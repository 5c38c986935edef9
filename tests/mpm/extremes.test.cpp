#include "mpm/verify/extremes.hpp"

#include <catch2/catch.hpp>

using namespace flowslide::mpm;

TEST_CASE("Runs with settings over twenty decades end by themselves", "[mpm]") {
  // The first of those of `flowslide verify mpm/extremes`; a crash ends this program.
  int finished = 0, stopped = 0;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    const Extreme r = run_extreme(seed);
    CAPTURE(seed, r.scene, r.message);
    CHECK((r.code == 0 || r.code == 2 || r.code == 3));
    finished += r.code == 0;
    stopped += r.code == 3;
  }
  CHECK(finished >= 4);
  CHECK(stopped >= 4);
}
