#include "verify/mpm/extremes.hpp"

#include <chrono>
#include <cstdio>
#include <cstdlib>

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

TEST_CASE("As many of them as FLOWSLIDE_SEEDS says, with what became of each", "[.extremes]") {
  const char* last = std::getenv("FLOWSLIDE_SEEDS");
  REQUIRE(last);
  const char* first = std::getenv("FLOWSLIDE_FIRST_SEED");
  using Clock = std::chrono::steady_clock;
  for (int seed = first ? std::atoi(first) : 1; seed <= std::atoi(last); ++seed) {
    const Clock::time_point start = Clock::now();
    const Extreme r = run_extreme(static_cast<std::uint64_t>(seed));
    const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
    std::printf("%d: %d in %.2f s | %s | %s\n", seed, r.code, seconds, r.scene.c_str(),
                r.message.c_str());
    std::fflush(stdout);
    CHECK((r.code == 0 || r.code == 2 || r.code == 3));
  }
}
