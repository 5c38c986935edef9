#pragma once
#include "constitutive/materials.hpp"
#include "constitutive/point_driver.hpp"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

/// What `flowslide point` runs: one material point along a path, from settings.
namespace flowslide {

struct PointMaterial {
  LawSettings<AllLaws> laws;
};

/// The consolidated state; compression positive here, as in the laboratory.
struct PointStress {
  double vertical = kUnset;  ///< sigma'_v [Pa]
  double k0 = 0.5;
  double shear = 0.0;     ///< tau [Pa]
  bool compacts = false;  ///< consolidation lowers the void ratio (PM4Sand)
};

/// Direct simple shear; with none of the three reversals it is monotonic.
struct PointShear {
  bool drained = false;
  std::optional<double> csr;              ///< turns at |tau| = csr sigma'_v0
  std::optional<double> reversal_stress;  ///< turns at |tau| [Pa]
  std::optional<double> reversal_strain;  ///< turns at |gamma|
  double stop_strain = 0.03;
  double strain_step = 5e-6;
  int max_cycles = 50;
};

/// A leg of a path: each component has a strain to add or a stress to reach; neither: no strain.
struct PointLeg {
  std::optional<double> strain_xx = {}, strain_yy = {}, gamma_xy = {};  ///< [-], extension positive
  std::optional<double> stress_xx = {}, stress_yy = {}, tau_xy = {};    ///< [Pa], tension positive
  int steps = 100;
};

struct PointConfig {
  PointMaterial material;
  PointStress stress;
  std::optional<PointShear> simple_shear;
  std::vector<PointLeg> path;
};

/// One law; exactly one of simple_shear and path; sizes that end. Throws InputError.
void check(const PointConfig& config);

struct PointRow {
  double gamma, eps_xx, eps_yy;    ///< since the start, extension positive
  double sigma_xx, sigma_yy, tau;  ///< effective, tension positive [Pa]
  int half_cycles;                 ///< or the leg, from 0
};

struct PointReport {
  std::string law;
  std::vector<PointRow> rows;                              ///< the first is the start
  std::vector<std::pair<std::string, std::string>> facts;  ///< what happened, for people
  std::vector<std::string> warnings = {};                  ///< where it is not what was asked for
};

/// Throws InputError for a consolidated stress that the law cannot carry or a test without end,
/// NumericsError where a prescribed stress cannot be reached, with the leg and step.
PointReport run_point(const PointConfig& config);

/// Heading and rows: gamma, eps_xx, eps_yy, sigma_xx_pa, sigma_yy_pa, tau_pa, r_u, half_cycles.
std::string point_csv(const PointReport& report);

template <>
struct Schema<PointConfig> {
  static constexpr std::string_view doc = "One material point along a path.";
  static void describe(FieldVisitor& v, PointConfig& c);
};

}  // namespace flowslide
