#include "study/numbers/sobol.hpp"

#include "core/check.hpp"

#include <array>

namespace flowslide::study {
namespace {

constexpr std::size_t kBits = 32;

/// A primitive polynomial over two elements and the first direction numbers for it.
struct Direction {
  unsigned degree, coefficients;
  std::array<std::uint32_t, 7> first;
};

// The first lines of "new-joe-kuo-6.21201", https://web.maths.unsw.edu.au/~fkuo/sobol/
// (c) 2008 Frances Y. Kuo and Stephen Joe, BSD-3-Clause.
constexpr std::array<Direction, kSobolInputs - 1> kDirections{{
    {1, 0, {1}},
    {2, 1, {1, 3}},
    {3, 1, {1, 3, 1}},
    {3, 2, {1, 1, 1}},
    {4, 1, {1, 1, 3, 3}},
    {4, 4, {1, 3, 5, 13}},
    {5, 2, {1, 1, 5, 5, 17}},
    {5, 4, {1, 1, 5, 5, 5}},
    {5, 7, {1, 1, 7, 11, 19}},
    {5, 11, {1, 1, 5, 1, 1}},
    {5, 13, {1, 1, 1, 3, 11}},
    {5, 14, {1, 3, 5, 5, 31}},
    {6, 1, {1, 3, 3, 9, 7, 49}},
    {6, 13, {1, 1, 1, 15, 21, 21}},
    {6, 16, {1, 3, 1, 13, 27, 49}},
    {6, 19, {1, 1, 1, 15, 7, 5}},
    {6, 22, {1, 3, 1, 15, 13, 25}},
    {6, 25, {1, 1, 5, 5, 19, 61}},
    {7, 1, {1, 3, 7, 11, 23, 15, 103}},
    {7, 4, {1, 3, 7, 13, 13, 15, 69}},
}};

std::array<std::uint32_t, kBits> directions(std::size_t input) {
  std::array<std::uint32_t, kBits> v{};
  if (input == 0) {
    for (std::size_t i = 0; i < kBits; ++i) v[i] = 1u << (kBits - 1 - i);
    return v;
  }
  const Direction& d = kDirections[input - 1];
  for (std::size_t i = 0; i < kBits; ++i) {
    if (i < d.degree) {
      v[i] = d.first[i] << (kBits - 1 - i);
      continue;
    }
    v[i] = v[i - d.degree] ^ (v[i - d.degree] >> d.degree);
    for (unsigned k = 1; k < d.degree; ++k)
      if ((d.coefficients >> (d.degree - 1 - k)) & 1u) v[i] ^= v[i - k];
  }
  return v;
}

}  // namespace

std::vector<std::uint32_t> sobol_point(std::size_t index, std::size_t inputs) {
  validate(inputs <= kSobolInputs,
           "{} inputs (the sequence of Sobol is kept for {}) take latin_hypercube", inputs,
           kSobolInputs);
  // Point n in Gray order, which is the order of the published generators.
  const std::size_t gray = index ^ (index >> 1u);
  std::vector<std::uint32_t> point(inputs, 0);
  for (std::size_t d = 0; d < inputs; ++d) {
    const auto v = directions(d);
    for (std::size_t bit = 0; bit < kBits; ++bit)
      if ((gray >> bit) & 1u) point[d] ^= v[bit];
  }
  return point;
}

}  // namespace flowslide::study
