#include "core/memory.hpp"

#include "core/check.hpp"

#include <catch2/catch.hpp>

using namespace flowslide;

TEST_CASE("What does not fit in memory is refused with the numbers", "[core]") {
  CHECK(available_memory() > 1e6);
  CHECK(machine_memory() > available_memory());
  CHECK_NOTHROW(need_memory(1.0, "a stone", "throw it"));
  try {
    need_memory(1e18, "a mountain", "move it");
    FAIL("nothing was refused");
  } catch (const InputError& e) {
    CHECK_THAT(e.what(), Catch::Contains("a mountain would need about 1e+09 GB") &&
                             Catch::Contains("GB to give) move it"));
  }
}
