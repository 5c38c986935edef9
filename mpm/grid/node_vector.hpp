#pragma once
#include "core/pack.hpp"
#include "mpm/grid/grid.hpp"

/// The sums of a node as vectors, and points turned from lanes into records.
namespace flowslide::mpm {

inline constexpr int kNodeLanes = 8;
/// Laid out as Node::q; plain vector extension of GCC and Clang.
using NodeVector = double __attribute__((vector_size(64), aligned(64)));

/// What one register of the target holds of a NodeVector. The lanes of a node hang on nothing but
/// themselves, so that a sweep may take part after part: the sums of the 9 nodes of a quadratic
/// spline fill 9 registers, where those of all lanes at once would need 18 of the 16 that AVX2 has.
using NodePart = Pack::Vector;
inline constexpr int kNodeParts = kNodeLanes / Pack::lanes;

/// `weight` in the lanes of mass and momentum, `gradient` in those of the force.
template <int Dim, int kPart>
[[gnu::always_inline]] inline NodePart weight_and_gradient(double weight,
                                                           double gradient) noexcept {
  typename VectorOf<Pack::lanes>::Whole force{};
  for (int k = 0; k < Pack::lanes; ++k) {
    const int lane = kPart * Pack::lanes + k;
    force[k] = lane >= NodeLayout<Dim>::force && lane < NodeLayout<Dim>::force + Dim ? -1 : 0;
  }
  return force ? gradient - NodePart{} : weight - NodePart{};
}

/// out[k][lane] = in[lane][k].
[[gnu::always_inline]] inline void transpose(const Pack* in,
                                             NodePart (&out)[Pack::lanes]) noexcept {
#if defined(__AVX512F__)
  NodePart a[8], b[8];
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
#elif defined(__AVX__)
  NodePart a[4];
  for (int i = 0; i < 4; i += 2) {
    a[i] = __builtin_shufflevector(in[i].v, in[i + 1].v, 0, 4, 2, 6);
    a[i + 1] = __builtin_shufflevector(in[i].v, in[i + 1].v, 1, 5, 3, 7);
  }
  for (int k = 0; k < 2; ++k) {
    out[k] = __builtin_shufflevector(a[k], a[k + 2], 0, 1, 4, 5);
    out[k + 2] = __builtin_shufflevector(a[k], a[k + 2], 2, 3, 6, 7);
  }
#else
  out[0] = __builtin_shufflevector(in[0].v, in[1].v, 0, 2);
  out[1] = __builtin_shufflevector(in[0].v, in[1].v, 1, 3);
#endif
}

}  // namespace flowslide::mpm
