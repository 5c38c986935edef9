#pragma once
#include "model/mesh.hpp"

#include <cstdint>

/// Meshes for tests of the transfer.
namespace flowslide::test {

/// Repeatable numbers in [-1, 1).
class Noise {
 public:
  explicit Noise(std::uint64_t seed) : state_(seed * 2862933555777941757ULL + 3037000493ULL) {}
  double operator()() {
    state_ = state_ * 6364136223846793005ULL + 1442695040888963407ULL;
    return static_cast<double>(state_ >> 11) / 4503599627370496.0 - 1.0;
  }

 private:
  std::uint64_t state_;
};

/// nx x ny quadrilaterals on [x0, x0 + width] x [0, height]; inner nodes are moved by up to
/// `distortion` element sizes, so that the outline stays a rectangle. Material tag 1.
inline QuadMesh distorted_mesh(int nx, int ny, double x0, double width, double height,
                               double distortion, std::uint64_t seed) {
  QuadMesh mesh;
  Noise noise(seed);
  for (int j = 0; j <= ny; ++j) {
    for (int i = 0; i <= nx; ++i) {
      const bool inner = i > 0 && i < nx && j > 0 && j < ny;
      const double dx = inner ? distortion * noise() : 0.0, dy = inner ? distortion * noise() : 0.0;
      mesh.nodes.push_back({x0 + width * (i + dx) / nx, height * (j + dy) / ny});
      mesh.node_tags.push_back(100 + static_cast<std::int64_t>(mesh.node_tags.size()));
    }
  }
  for (int j = 0; j < ny; ++j) {
    for (int i = 0; i < nx; ++i) {
      const int n = j * (nx + 1) + i;
      mesh.elements.push_back({n, n + 1, n + nx + 2, n + nx + 1});
      mesh.element_tags.push_back(500 + static_cast<std::int64_t>(mesh.element_tags.size()));
      mesh.element_material.push_back(1);
    }
  }
  return mesh;
}

}  // namespace flowslide::test
