#include "core/staggered_array.hpp"

#include <cstdint>
#include <numeric>
#include <set>

#include <catch2/catch.hpp>

using namespace flowslide;

TEST_CASE("Staggered arrays start on different lines of a page and keep what is put in", "[core]") {
  for (const std::size_t n :
       {std::size_t{1}, std::size_t{100}, std::size_t{40000}, std::size_t{600000}}) {
    std::vector<StaggeredArray<double>> arrays(26);
    std::set<std::uintptr_t> lines;
    for (auto& a : arrays) {
      a.assign(n, 0.0);
      std::iota(a.begin(), a.end(), double(&a - arrays.data()));
      const auto at = reinterpret_cast<std::uintptr_t>(a.data());
      CHECK(at % 64 == 0);
      lines.insert(at % 4096);
    }
    // Twelve arrays on one line fill the ways of a first-level cache.
    if (n >= 40000) CHECK(lines.size() == 26);
    for (const auto& a : arrays) {
      CHECK(a.front() == double(&a - arrays.data()));
      CHECK(a.back() == double(&a - arrays.data()) + double(n - 1));
    }
  }
}

TEST_CASE("A staggered array that cannot be had is refused", "[core]") {
  StaggeredArray<double> a;
  CHECK_THROWS(a.reserve(std::size_t{1} << 59));
}
