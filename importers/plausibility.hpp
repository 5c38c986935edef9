#pragma once
#include "core/check.hpp"
#include "importers/strain_watch.hpp"
#include "model/history.hpp"

#include <string>
#include <vector>

/// Looks for wrong signs, units and recorder responses in a state in SI. They are warnings: a model
/// may be unusual, and nothing is corrected by guessing.
namespace flowslide {

/// Sign of the vertical effective stress; total vertical stress against the weight above
/// (weight_check.hpp); pore pressure that is nowhere noticeable. `unit` is that of stress [Pa].
std::vector<std::string> gravity_warnings(const QuadMesh& mesh,
                                          const std::vector<HistoryMaterial>& materials,
                                          const FemFrame& gravity, double unit);

/// Stress and pore pressure must start from the gravity state: a pore pressure recorded as `disp`
/// or `accel` of its degree of freedom, or a gravity row of another stage, does not.
std::vector<std::string> start_warnings(const FemFrame& gravity, const FemFrame& first);

/// Follows the motion of a mesh: displacements larger than the section cannot be, those larger than
/// half its height are odd, elements must not fold, what nodes move by is about what their velocity
/// carries them, and strains are those of the displacements.
class MotionWatch {
 public:
  explicit MotionWatch(const QuadMesh& mesh);
  /// Throws InputError with node and time for a displacement that cannot be.
  void look_at(const FemFrame& frame);
  [[nodiscard]] std::vector<std::string> warnings() const;

 private:
  void compare_velocity(const FemFrame& frame);

  const QuadMesh& mesh_;
  double length_ = 0.0, height_ = 0.0;  ///< of the section [m]
  double largest_ = 0.0, largest_time_ = 0.0;
  std::size_t largest_node_ = 0;
  std::size_t folded_ = 0;  ///< elements in the first frame that has any
  std::size_t folded_element_ = 0;
  double folded_time_ = 0.0;
  double last_time_ = kUnset;
  std::vector<Vec2> last_displacement_, last_velocity_;
  StrainWatch strains_;
  double moved_ = 0.0, carried_ = 0.0;  ///< ways of the mean node by displacement, by velocity [m]
};

}  // namespace flowslide
