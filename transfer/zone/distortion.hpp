#pragma once
#include "core/voigt.hpp"
#include "model/mesh.hpp"

#include <cstdint>
#include <span>
#include <vector>

/// Mesh distortion Q of the strained elements (docs/theory/liquefaction-zone.md, section 4).
namespace flowslide {

struct Distortion {
  double gauss = 1.0;     ///< mean of the smallest det J_t / det J_0 of the 2x2 Gauss points
  double centre = 1.0;    ///< mean of det J_t / det J_0 at the centre
  std::size_t count = 0;  ///< elements with eps_q above the threshold; 0 leaves Q = 1
};

/// Over the listed elements whose deviatoric strain exceeds strain_threshold. `positions` are the
/// current node coordinates, `strain` has one entry per element of the mesh.
Distortion distortion(const QuadMesh& mesh, std::span<const std::int32_t> elements,
                      const std::vector<Vec2>& positions,
                      std::span<const StrainIncrement<2>> strain, double strain_threshold);

}  // namespace flowslide
