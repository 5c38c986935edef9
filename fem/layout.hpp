#pragma once
#include "fem/element.hpp"
#include "fem/gather.hpp"

#include <algorithm>

/// How the solver stores a model: elements sorted by law, so that one loop meets one law.
namespace flowslide::fem {

struct Layout {
  std::vector<std::int32_t> order;  ///< solver element -> mesh element
  /// First element of each law of ShakingLaws, and the end.
  std::array<std::size_t, ShakingLaws::size + 1> law_begin;
  Elements elements;
  std::vector<std::int32_t> material;              ///< of each solver element
  std::vector<std::array<std::int32_t, 4>> nodes;  ///< of each solver element
  std::vector<std::array<std::int32_t, 8>> dofs;   ///< x and y of its nodes in turn
  Gather forces;                                   ///< unknowns of motion from entries 8 e + i
  std::vector<double> mass;                        ///< lumped, of each unknown of motion [kg]
  std::vector<double> weight;                      ///< body force of each unknown [N]
  std::vector<std::uint8_t> saturated;             ///< element has pore pressure unknowns
};

Layout make_layout(const Model& model);

/// Calls f.template operator()<M>(first, last) for the elements `begin` to `end`, law by law.
template <class F>
void each_law(const Layout& l, std::size_t begin, std::size_t end, F&& f) {
  ShakingLaws::each([&]<class M>() {
    constexpr std::size_t k = ShakingLaws::index<M>();
    const std::size_t first = std::max(begin, l.law_begin[k]);
    const std::size_t last = std::min(end, l.law_begin[k + 1]);
    if (first < last) f.template operator()<M>(first, last);
  });
}

}  // namespace flowslide::fem
