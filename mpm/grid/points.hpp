#pragma once
#include "core/staggered_array.hpp"
#include "core/voigt.hpp"

#include <array>
#include <cstdint>
#include <vector>

/// Material points as the solver keeps them: one array per component, sorted by tile and, inside a
/// tile, by material.
namespace flowslide::mpm {

/// Most state variables any constitutive law has.
inline constexpr int kMaxState = 4;

template <int Dim>
struct Points {
  using Array = StaggeredArray<double>;
  std::array<Array, Dim> x;              ///< position [m]
  std::array<Array, Dim> v;              ///< velocity [m/s]
  std::array<Array, Dim * Dim> c;        ///< affine velocity field, row-major [1/s]
  std::array<Array, kVoigt<Dim>> sigma;  ///< total stress [Pa]
  Array mass;                            ///< [kg], plane strain: per metre of width
  Array volume;                          ///< [m3], likewise
  std::array<Array, kMaxState> state;    ///< state variables of the point's law, in its own order
  std::vector<std::int32_t> material;    ///< index into the material list
  std::vector<std::int32_t> index;       ///< position in the ParticleSet the run started from

  [[nodiscard]] std::size_t size() const { return mass.size(); }
};

/// Calls f(array of p, the same of q) for every per-point array: the one list that sorting,
/// checkpoints and resizing use.
template <class P, class Q, class F>
void visit_arrays(P& p, Q& q, F&& f) {
  const auto each = [&](auto& a, auto& b) {
    for (std::size_t k = 0; k < a.size(); ++k) f(a[k], b[k]);
  };
  each(p.x, q.x);
  each(p.v, q.v);
  each(p.c, q.c);
  each(p.sigma, q.sigma);
  f(p.mass, q.mass);
  f(p.volume, q.volume);
  each(p.state, q.state);
  f(p.material, q.material);
  f(p.index, q.index);
}

/// Calls f(array) for every per-point array.
template <class P, class F>
void visit_arrays(P& p, F&& f) {
  visit_arrays(p, p, [&](auto& array, auto&) { f(array); });
}

}  // namespace flowslide::mpm
