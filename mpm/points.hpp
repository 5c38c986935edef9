#pragma once
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
  using Array = std::vector<double>;
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

/// Calls f(array) for every per-point array: the one list that sorting, checkpoints and resizing
/// use.
template <class P, class F>
void visit_arrays(P& p, F&& f) {
  for (auto& a : p.x) f(a);
  for (auto& a : p.v) f(a);
  for (auto& a : p.c) f(a);
  for (auto& a : p.sigma) f(a);
  f(p.mass);
  f(p.volume);
  for (auto& a : p.state) f(a);
  f(p.material);
  f(p.index);
}

}  // namespace flowslide::mpm
