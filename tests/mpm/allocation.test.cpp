#include "tests/mpm/scene.hpp"

#include <atomic>
#include <cstdlib>
#include <new>

#include <catch2/catch.hpp>

namespace {
std::atomic<long> allocations{0};
}

// Counts every allocation of this executable.
[[gnu::noinline]] void* operator new(std::size_t size) {
  ++allocations;
  if (void* p = std::malloc(size ? size : 1)) return p;
  throw std::bad_alloc();
}
[[gnu::noinline]] void* operator new(std::size_t size, std::align_val_t align) {
  ++allocations;
  const auto a = static_cast<std::size_t>(align);
  if (void* p = std::aligned_alloc(a, (size + a - 1) / a * a)) return p;
  throw std::bad_alloc();
}
[[gnu::noinline]] void operator delete(void* p) noexcept { std::free(p); }
[[gnu::noinline]] void operator delete(void* p, std::size_t) noexcept { std::free(p); }
[[gnu::noinline]] void operator delete(void* p, std::align_val_t) noexcept { std::free(p); }
[[gnu::noinline]] void operator delete(void* p, std::size_t, std::align_val_t) noexcept {
  std::free(p);
}

using namespace flowslide;
using namespace flowslide::mpm;

TEST_CASE("A step allocates nothing unless points are binned", "[mpm]") {
  ParticleSet p;
  p.materials = {liquefied(2e6, 5e3)};
  add_lattice(p, {0.0, 0.0, 6.0, 3.0}, 0.25, 1800.0);
  FlowConfig config = free_space(0.5);
  config.gravity = 9.81;
  config.ground.surface = {{0.0, 0.0}};
  Run run(p, config);
  run.step(3);
  const long before = allocations;
  int counted = 0;
  while (run.s.drift <= 0.8 * config.cell) {
    run.step();
    ++counted;
  }
  CHECK(allocations - before == 0);
  CHECK(counted > 50);

  const long now = allocations;  // control: the counter sees a vector
  std::vector<double> v(10);
  CHECK(allocations - now == 1);
}
