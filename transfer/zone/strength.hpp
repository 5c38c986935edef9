#pragma once
#include "config/schema.hpp"

#include <array>
#include <map>
#include <string>
#include <string_view>
#include <vector>

/// Residual strength of liquefied soil from its initial vertical effective stress
/// (docs/theory/liquefaction-zone.md, section 6).
namespace flowslide {

enum class StrengthRule { interpolated, binned };
inline constexpr std::array<std::string_view, 2> kStrengthRules{"interpolated", "binned"};

/// Rows [sigma'_v0, S_r], both in Pa, sigma'_v0 rising.
using StrengthTable = std::vector<std::vector<double>>;

struct MaterialStrength {
  StrengthTable table;
};

struct StrengthConfig {
  StrengthTable table;
  std::map<std::string, MaterialStrength> materials = {};  ///< their own tables, in its place
  StrengthRule rule = StrengthRule::interpolated;
  double bin_width = 50e3;  ///< [Pa]
  double last_bin = 300e3;  ///< lower edge of the open last bin [Pa], a multiple of bin_width
};

/// Throws InputError: at least one row, sigma'_v0 rising, positive strengths, whole bins.
void check(const StrengthConfig& config);

/// What holds for a material: its own table in place of the common one, where it has one.
StrengthConfig strength_of(const StrengthConfig& config, const std::string& material);

struct LayerStrength {
  double strength = 0.0;  ///< S_r [Pa]
  int layer = 0;          ///< bin of sigma'_v0, 0 nearest to the surface
  bool clamped = false;   ///< the table was left; its first or last value was used
};

/// S_r and layer at sigma_v0 [Pa], compression positive. Bins are [k w, (k+1) w); the last one is
/// open. Tension counts as zero stress. Expects a checked config and a finite stress.
LayerStrength strength_at(const StrengthConfig& config, double sigma_v0);

template <>
struct Schema<MaterialStrength> {
  static constexpr std::string_view doc = "Residual strength of one material.";
  static void describe(FieldVisitor& v, MaterialStrength& c);
};

template <>
struct Schema<StrengthConfig> {
  static constexpr std::string_view doc = "Residual strength of the liquefied soil.";
  static void describe(FieldVisitor& v, StrengthConfig& c);
};

}  // namespace flowslide
