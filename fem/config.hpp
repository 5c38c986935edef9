#pragma once
#include "config/schema.hpp"
#include "fem/model.hpp"

#include <array>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

/// Settings of a dynamic finite-element run. docs/theory/fem.md
namespace flowslide {

struct PermeabilityRiseConfig {
  double factor = kUnset;
  double exponent = 1.0;
};

struct FemMaterialConfig {
  double density = kUnset;                             ///< saturated [kg/m3]
  double void_ratio = kUnset;                          ///< [-]
  std::array<double, 2> permeability{kUnset, kUnset};  ///< horizontal, vertical [m/s]
  std::optional<PermeabilityRiseConfig> permeability_rise;
  double k0 = 0.5;
  bool drained = false;
  LawSettings<ShakingLaws> laws;
};

struct WaterConfig {
  std::vector<std::vector<double>> table;  ///< rows x, y [m]
  double bulk_modulus = 2.2e9;             ///< [Pa]
  double density = 1000.0;                 ///< [kg/m3]
  std::vector<std::string> drains;         ///< edge sets where u = 0
};

struct FemGravityConfig {
  double acceleration = kGravity;      ///< [m/s2]
  std::optional<double> permeability;  ///< of all soil while water settles [m/s]
  bool compacts = false;
};

enum class BaseMotionKind { outcrop, within };
inline constexpr std::array<std::string_view, 2> kBaseMotionKinds{"outcrop", "within"};

struct FemBaseConfig {
  BaseMotionKind motion = BaseMotionKind::outcrop;
  std::optional<double> shear_wave_velocity;  ///< of the rock below [m/s]
  std::optional<double> density;              ///< of the rock below [kg/m3]
  bool rigid_plane = true;
};

enum class SideKind { free_field, tied, fixed };
inline constexpr std::array<std::string_view, 3> kSideKinds{"free_field", "tied", "fixed"};

struct FemSideConfig {
  SideKind kind = SideKind::free_field;
  double width = 3.0;         ///< of a free-field column [m]
  double thickness = 1000.0;  ///< of a free-field column out of the plane [m]
};

/// An implicit integration whose numerical damping is to be added.
struct LikeNewmarkConfig {
  double gamma = 5.0 / 6.0;
  double step = 0.01;  ///< [s]
};

struct FemDampingConfig {
  double ratio = 0.02;
  std::array<double, 2> frequencies{0.6, 5.0};  ///< [Hz]
  std::optional<double> mass;                   ///< [-], 1/s
  std::optional<double> stiffness;              ///< [s]
  std::optional<LikeNewmarkConfig> like_newmark;
  std::optional<double> largest_ratio;  ///< of the fastest motion of any element
};

struct StabilisationConfig {
  double pressure = 0.25;         ///< alpha M/A
  std::optional<double> modulus;  ///< M [Pa]
  double hourglass = 1.0;         ///< factor on the hourglass stiffness
  bool hourglass_yields = true;   ///< at the strength of the soil
};

enum class IntegrationScheme { explicit_steps, implicit };
inline constexpr std::array<std::string_view, 2> kIntegrationSchemes{"explicit", "implicit"};

/// All but the scheme belong to implicit steps.
struct IntegrationConfig {
  IntegrationScheme scheme = IntegrationScheme::explicit_steps;
  double step = 5e-3;           ///< largest [s]
  double smallest_step = 2e-5;  ///< [s]
  double tolerance = 1e-4;      ///< of a node's weight
  int max_iterations = 40;
  double theta = 0.5;
};

struct FemConfig {
  std::map<std::string, FemMaterialConfig> materials;
  std::optional<WaterConfig> water;
  FemGravityConfig gravity;
  FemBaseConfig base;
  FemSideConfig sides;
  FemDampingConfig damping;
  StabilisationConfig stabilisation;
  IntegrationConfig integration;
  std::optional<double> softening_length;   ///< over which the laws' strains hold as given [m]
  std::optional<double> end;                ///< [s]; the duration of the motion if left out
  std::optional<double> stop_displacement;  ///< against the base [m]
  double output_interval = 0.1;             ///< [s]
  double courant = 0.5;
};

/// Relations that ranges cannot express. Throws InputError.
void check(const FemConfig& c);

template <>
struct Schema<PermeabilityRiseConfig> {
  static constexpr std::string_view doc =
      "Permeability that grows with the excess pore-pressure ratio r_u, times 1 + (factor - 1) "
      "r_u^exponent, as it does in sand that liquefies; left out: constant.";
  static void describe(FieldVisitor& v, PermeabilityRiseConfig& c);
};
template <>
struct Schema<FemMaterialConfig> {
  static constexpr std::string_view doc = "A soil; exactly one of the laws.";
  static void describe(FieldVisitor& v, FemMaterialConfig& c);
};
template <>
struct Schema<WaterConfig> {
  static constexpr std::string_view doc = "Pore water and where it stands at rest.";
  static void describe(FieldVisitor& v, WaterConfig& c);
};
template <>
struct Schema<FemGravityConfig> {
  static constexpr std::string_view doc = "The state before shaking.";
  static void describe(FieldVisitor& v, FemGravityConfig& c);
};
template <>
struct Schema<FemBaseConfig> {
  static constexpr std::string_view doc =
      "How the motion enters. With the rock's shear wave velocity and density the base is "
      "compliant "
      "(dashpots after Lysmer and Kuhlemeyer); without them it follows the motion rigidly.";
  static void describe(FieldVisitor& v, FemBaseConfig& c);
};
template <>
struct Schema<FemSideConfig> {
  static constexpr std::string_view doc = "The vertical ends of the section.";
  static void describe(FieldVisitor& v, FemSideConfig& c);
};
template <>
struct Schema<LikeNewmarkConfig> {
  static constexpr std::string_view doc =
      "Adds the damping that Newmark's method has of its own where gamma is above 1/2, to follow a "
      "program that integrates with it: a stiffness factor (gamma - 1/2) step. No property of soil.";
  static void describe(FieldVisitor& v, LikeNewmarkConfig& c);
};
template <>
struct Schema<FemDampingConfig> {
  static constexpr std::string_view doc =
      "Rayleigh damping: a ratio at two frequencies, or both factors.";
  static void describe(FieldVisitor& v, FemDampingConfig& c);
};
template <>
struct Schema<StabilisationConfig> {
  static constexpr std::string_view doc = "What single-point elements need besides the physics.";
  static void describe(FieldVisitor& v, StabilisationConfig& c);
};
template <>
struct Schema<IntegrationConfig> {
  static constexpr std::string_view doc =
      "Time integration of the shaking. Implicit steps are a check of the explicit ones; all "
      "settings but the scheme are theirs.";
  static void describe(FieldVisitor& v, IntegrationConfig& c);
};
template <>
struct Schema<FemConfig> {
  static constexpr std::string_view doc =
      "Dynamic finite-element run of a saturated section in plane strain: gravity, then shaking.";
  static void describe(FieldVisitor& v, FemConfig& c);
};

}  // namespace flowslide
