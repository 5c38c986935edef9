#include "motion/fourier.hpp"

#include "core/conventions.hpp"

#include <cmath>

#include <catch2/catch.hpp>

using namespace flowslide;

TEST_CASE("A transform is the sum that defines it, and comes back", "[motion]") {
  const std::size_t n = GENERATE(1u, 2u, 3u, 7u, 8u, 30u, 64u, 90u);
  std::vector<double> x(n);
  for (std::size_t i = 0; i < n; ++i) x[i] = std::sin(1.7 * double(i * i)) + 0.3;
  const auto c = half_spectrum(x);
  REQUIRE(c.size() == n / 2 + 1);
  for (std::size_t k = 0; k < c.size(); ++k) {
    std::complex<double> sum = 0.0;
    for (std::size_t j = 0; j < n; ++j)
      sum += x[j] * std::polar(1.0, -2.0 * kPi * double(j * k % n) / double(n));
    CHECK(std::abs(c[k] - sum) < 1e-14 * double(n));
  }
  const std::vector<double> back = samples_of(c, n);
  REQUIRE(back.size() == n);
  for (std::size_t i = 0; i < n; ++i) CHECK(back[i] == Approx(x[i]).margin(1e-14));
}
