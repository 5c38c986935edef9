#pragma once
#include "fem/element.hpp"
#include "fem/gather.hpp"

/// How the solver stores a model: elements sorted by law, so that one loop meets one law.
namespace flowslide::fem {

struct Layout {
  std::vector<std::int32_t> order;       ///< solver element -> mesh element
  std::array<std::size_t, 4> law_begin;  ///< first element of each alternative of Law, and the end
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

}  // namespace flowslide::fem
