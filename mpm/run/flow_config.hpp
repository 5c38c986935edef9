#pragma once
#include "config/schema.hpp"
#include "model/rest_rule.hpp"
#include "mpm/kernels/scheme.hpp"

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

/// Settings of a runout. docs/theory/mpm.md
namespace flowslide {

using mpm::VolumeAverage;
enum class Sides { smooth, rough, open };
enum class Stiffness { given, automatic };

struct SofteningSettings {
  bool regularise = true;
  /// Cell for which strains hold as given [m]; no run of soil that softens begins without it.
  std::optional<double> reference_length;
  /// By which cells of this size [m] divide the strains.
  [[nodiscard]] double scale(double cell) const {
    return regularise && reference_length ? cell / *reference_length : 1.0;
  }
};

/// A height field in place of the ground's polyline, in three dimensions.
struct TerrainSettings {
  InputFile file;
  std::array<double, 2> origin{};  ///< of the scene, in map coordinates [m]
  double heading = 0.0;            ///< of x on the map, counter-clockwise [rad]
  double level = 0.0;              ///< map height of z = 0 [m]
};

struct GroundSettings {
  std::vector<std::vector<double>> surface = {{0.0, 0.0}};  ///< rows x, y [m]
  std::optional<TerrainSettings> terrain;
  double friction = 0.70;  ///< [-]
};

struct AbsorbingSettings {
  std::optional<double> left, right, bottom;  ///< [m]
};

struct ExtrudeSettings {
  double width = kUnset;  ///< [m]
  Sides sides = Sides::smooth;
};

struct SleepSettings {
  double speed = 0.01;  ///< [m/s]
  double after = 1.0;   ///< [s]
};

/// docs/theory/stiffness.md
struct StiffnessBounds {
  double volume_change = 0.01;  ///< [-]
  double mach_number = 0.1;     ///< [-]
  double brittleness = 0.1;     ///< [-]
};

struct OutletSettings {
  std::optional<double> left, right, bottom, top;  ///< [m]
};

struct TractionSettings {
  std::array<double, 2> from{kUnset, kUnset}, to{kUnset, kUnset};  ///< [m]
  double pressure = kUnset;                                        ///< [Pa]
  double shear = 0.0;                                              ///< [Pa]
  double begin = 0.0, ramp = 0.0;                                  ///< [s]
};

/// Where and for how long the steps are taken, beside what is set about each of them.
struct FlowConfig : mpm::StepSettings {
  FlowConfig() { transfer = mpm::Transfer::aflip; }  ///< docs/adr/0009-transfer-of-velocity.md
  double cell = kUnset;                              ///< [m]
  std::array<double, 2> grid_origin{};               ///< [m]
  double end = kUnset;                               ///< [s]
  GroundSettings ground;
  AbsorbingSettings absorbing;
  OutletSettings outlet;
  std::vector<TractionSettings> tractions;
  std::optional<double> left_roller;   ///< x [m]
  std::optional<double> right_roller;  ///< x [m]
  std::optional<ExtrudeSettings> extrude;
  /// Walls at two y [m] in three dimensions, as `extrude` sets them.
  std::optional<std::array<double, 2>> side_rollers;
  SofteningSettings softening;
  Stiffness stiffness = Stiffness::given;
  StiffnessBounds stiffness_bounds;
  double gravity = 9.81;  ///< [m/s2]
  std::optional<SleepSettings> sleep;
  RestRule rest;
  double frame_interval = 5.0;         ///< [s]
  std::optional<double> frame_travel;  ///< [m]
  double sample_interval = 0.25;       ///< [s]
};

/// Relations that ranges cannot express. Throws InputError.
void check(const FlowConfig& c);

/// What is said of a material that softens in cells [m] where no length is given.
std::string no_reference_length(const std::string& material, double cell);

template <>
struct Schema<SofteningSettings> {
  static constexpr std::string_view doc = "How softening is kept independent of the cell size.";
  static void describe(FieldVisitor& v, SofteningSettings& c);
};
template <>
struct Schema<RestRule> {
  static constexpr std::string_view doc =
      "When the flow counts as at rest; both conditions must hold.";
  static void describe(FieldVisitor& v, RestRule& c);
};
template <>
struct Schema<TerrainSettings> {
  static constexpr std::string_view doc =
      "Heights of the ground in three dimensions, in place of its surface line.";
  static void describe(FieldVisitor& v, TerrainSettings& c);
};
template <>
struct Schema<GroundSettings> {
  static constexpr std::string_view doc = "The rigid ground under the flow.";
  static void describe(FieldVisitor& v, GroundSettings& c);
};
template <>
struct Schema<AbsorbingSettings> {
  static constexpr std::string_view doc =
      "Planes beyond which the soil goes on: waves leave there, and what held the soil at the "
      "start stays.";
  static void describe(FieldVisitor& v, AbsorbingSettings& c);
};
template <>
struct Schema<ExtrudeSettings> {
  static constexpr std::string_view doc =
      "Runs the section as a straight valley in three dimensions: x as in the section, y across, z "
      "up. Masses and energies of the time series are those of the whole width.";
  static void describe(FieldVisitor& v, ExtrudeSettings& c);
};
template <>
struct Schema<StiffnessBounds> {
  static constexpr std::string_view doc =
      "With stiffness automatic: what the soil must be stiff enough for. A bound that the given "
      "constants break is not mended.";
  static void describe(FieldVisitor& v, StiffnessBounds& c);
};
template <>
struct Schema<SleepSettings> {
  static constexpr std::string_view doc =
      "Leaves soil out of the steps while neither it nor what is near it moves; off unless given.";
  static void describe(FieldVisitor& v, SleepSettings& c);
};
template <>
struct Schema<OutletSettings> {
  static constexpr std::string_view doc =
      "Edges beyond which points leave the computation; their mass, momentum and energy are "
      "accounted for.";
  static void describe(FieldVisitor& v, OutletSettings& c);
};
template <>
struct Schema<TractionSettings> {
  static constexpr std::string_view doc =
      "Stretches of the surface under load, such as a footing or water on it; the load stays on "
      "the "
      "points it was put on and keeps its amount and direction.";
  static void describe(FieldVisitor& v, TractionSettings& c);
};
template <>
struct Schema<FlowConfig> {
  static constexpr std::string_view doc =
      "Explicit material-point runout in plane strain, or as a valley in three dimensions.";
  static void describe(FieldVisitor& v, FlowConfig& c);
};

}  // namespace flowslide
