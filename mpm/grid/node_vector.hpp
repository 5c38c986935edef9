#pragma once
#include "core/pack.hpp"
#include "mpm/grid/grid.hpp"

/// The sums of a node as one vector register, and points turned from lanes into records.
namespace flowslide::mpm {

inline constexpr int kNodeLanes = 8;
/// Laid out as Node::q; plain vector extension of GCC and Clang.
using NodeVector = double __attribute__((vector_size(64), aligned(64)));

/// `weight` in the lanes of mass and momentum, `gradient` in those of the force.
template <int Dim>
[[gnu::always_inline]] inline NodeVector weight_and_gradient(double weight,
                                                             double gradient) noexcept {
  using Mask = std::int64_t __attribute__((vector_size(64)));
  constexpr auto f = [](int lane) -> std::int64_t {
    return lane >= NodeLayout<Dim>::force && lane < NodeLayout<Dim>::force + Dim ? -1 : 0;
  };
  constexpr Mask force{f(0), f(1), f(2), f(3), f(4), f(5), f(6), f(7)};
  return force ? gradient - NodeVector{} : weight - NodeVector{};
}

/// out[k][lane] = in[lane][k].
[[gnu::always_inline]] inline void transpose(const Pack (&in)[kNodeLanes],
                                             NodeVector (&out)[Pack::lanes]) noexcept {
#if defined(__AVX512F__)
  NodeVector a[8], b[8];
  for (int i = 0; i < 8; i += 2) {
    a[i] = __builtin_shufflevector(in[i].v, in[i + 1].v, 0, 8, 2, 10, 4, 12, 6, 14);
    a[i + 1] = __builtin_shufflevector(in[i].v, in[i + 1].v, 1, 9, 3, 11, 5, 13, 7, 15);
  }
  for (int i = 0; i < 8; i += 4) {
    for (int k = 0; k < 2; ++k) {
      b[i + k] = __builtin_shufflevector(a[i + k], a[i + 2 + k], 0, 1, 8, 9, 4, 5, 12, 13);
      b[i + 2 + k] = __builtin_shufflevector(a[i + k], a[i + 2 + k], 2, 3, 10, 11, 6, 7, 14, 15);
    }
  }
  for (int k = 0; k < 4; ++k) {
    out[k] = __builtin_shufflevector(b[k], b[k + 4], 0, 1, 2, 3, 8, 9, 10, 11);
    out[k + 4] = __builtin_shufflevector(b[k], b[k + 4], 4, 5, 6, 7, 12, 13, 14, 15);
  }
#else
  for (int k = 0; k < Pack::lanes; ++k)
    for (int lane = 0; lane < kNodeLanes; ++lane) out[k][lane] = in[lane][k];
#endif
}

}  // namespace flowslide::mpm
