#pragma once
#include <array>
#include <cmath>
#include <stdexcept>

namespace flowslide {

/// Gauss-Legendre points and weights on [-1, 1]; only the first `order` entries are used.
struct GaussRule {
  std::array<double, 4> point{};
  std::array<double, 4> weight{};
};

/// order 1 to 4, from the closed forms of the Legendre roots; exact for polynomials of degree
/// 2 order - 1.
inline GaussRule gauss_rule(int order) {
  switch (order) {
    case 1:
      return {{0.0}, {2.0}};
    case 2:
      return {{-1.0 / std::sqrt(3.0), 1.0 / std::sqrt(3.0)}, {1.0, 1.0}};
    case 3:
      return {{-std::sqrt(0.6), 0.0, std::sqrt(0.6)}, {5.0 / 9.0, 8.0 / 9.0, 5.0 / 9.0}};
    case 4: {
      const double inner = std::sqrt(3.0 / 7.0 - 2.0 / 7.0 * std::sqrt(1.2));
      const double outer = std::sqrt(3.0 / 7.0 + 2.0 / 7.0 * std::sqrt(1.2));
      const double wi = (18.0 + std::sqrt(30.0)) / 36.0, wo = (18.0 - std::sqrt(30.0)) / 36.0;
      return {{-outer, -inner, inner, outer}, {wo, wi, wi, wo}};
    }
    default:
      throw std::logic_error("gauss_rule: order must be 1 to 4");
  }
}

}  // namespace flowslide
