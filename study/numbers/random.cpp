#include "study/numbers/random.hpp"

#include <numeric>
#include <utility>

namespace flowslide::study {
namespace {

constexpr std::uint64_t kStep = 0x9e3779b97f4a7c15u;

std::uint64_t mixed(std::uint64_t z) {
  z = (z ^ (z >> 30u)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27u)) * 0x94d049bb133111ebu;
  return z ^ (z >> 31u);
}

}  // namespace

Random::Random(std::uint64_t seed, std::uint64_t stream)
    : state_(mixed(seed + kStep) ^ mixed((stream + 1) * kStep)) {}

std::uint64_t Random::next() { return mixed(state_ += kStep); }

double Random::uniform() {
  return (static_cast<double>(next() >> 11u) + 0.5) * 0x1p-53;
}

std::size_t Random::below(std::size_t n) {
  // What is left over above the largest multiple of n would favour the first numbers.
  const std::uint64_t rest = (UINT64_MAX % n + 1) % n;
  std::uint64_t x = next();
  while (x > UINT64_MAX - rest) x = next();
  return static_cast<std::size_t>(x % n);
}

std::vector<std::size_t> Random::permutation(std::size_t n) {
  std::vector<std::size_t> order(n);
  std::iota(order.begin(), order.end(), std::size_t{0});
  for (std::size_t i = n; i > 1; --i) std::swap(order[i - 1], order[below(i)]);
  return order;
}

}  // namespace flowslide::study
