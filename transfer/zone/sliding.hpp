#pragma once
#include "model/mesh.hpp"

#include <cstdint>
#include <deque>
#include <span>
#include <vector>

/// Kinetic energy of the velocity averaged over a while, which shaking leaves small and a slide
/// does not (docs/theory/liquefaction-zone.md, section 3).
namespace flowslide {

/// Fed with the displacements of one instant after the other; before the first one the section
/// stood as in it.
class SlidingEnergy {
 public:
  /// @param length of the trailing mean [s]
  explicit SlidingEnergy(double length) : length_(length) {}

  struct Values {
    double section = 0.0;  ///< sum of 0.5 m_e |w_e - w_base|^2 [J/m], w the mean velocity
    double base = 0.0;     ///< 0.5 (sum of m_e) |w_base|^2 [J/m]
  };
  /// As kinetic_energy, with displacements; `time` must increase.
  Values append(double time, const QuadMesh& mesh, std::span<const std::int32_t> elements,
                std::span<const double> mass, std::span<const Vec2> displacement,
                std::span<const std::int32_t> base_nodes);

 private:
  struct Instant {
    double time = 0.0;
    Vec2 base{0.0, 0.0};
    std::vector<Vec2> relative;  ///< elements against the base [m]
  };
  double length_;
  std::deque<Instant> past_;  ///< the youngest that is `length_` old, and those after it
};

}  // namespace flowslide
