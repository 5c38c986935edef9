#pragma once
#include "config/schema.hpp"
#include "model/history.hpp"
#include "model/particle_set.hpp"

#include <array>
#include <string>
#include <string_view>
#include <vector>

/// The published transfer script of Sordo, Rathje and Kumar (github.com/bts2222/FEM-MPM-Transfer,
/// MochiRBF_Transfer_4p.py, 2024) as one mapping method, its defects included, so that old results
/// can be repeated and compared. docs/theory/compat-sordo2024.md has its equations and defects.
namespace flowslide {

enum class SordoLiquefied { all, line };
inline constexpr std::array<std::string_view, 2> kSordoLiquefiedNames{"all", "line"};

/// Materials of the section that the script knows, by name.
struct SordoSoils {
  std::string tailings = "tailings";
  std::string embankment = "embankment";
  std::string foundation = "foundation";
};

/// What the script holds as constants. Defaults are those of the Mochikoshi dam where the script
/// has them; element tags, base node and line belong to one mesh and one run.
struct SordoConfig {
  SordoSoils soils;
  int base_node = 175;  ///< node tag whose x displacement is taken as the movement of the base
  int saturated_embankment = 166;              ///< tag given to embankment under the water table
  std::array<double, 2> keep_x{-340.0, 87.5};  ///< points outside are dropped [m]
  std::array<double, 2> keep_y{-5.0, 100.0};
  double water_slope = -0.303;  ///< water table y = slope y + level, as the script has it
  double water_level = 18.427;  ///< [m]
  double r_u = 0.7;             ///< tailings above it are liquefied wherever they are
  SordoLiquefied liquefied = SordoLiquefied::all;
  std::vector<std::vector<double>> line;  ///< two points [m] for SordoLiquefied::line
  double youngs_modulus = 20e6;  ///< [Pa]; the script leaves elasticity to the runout program
  double poisson_ratio = 0.3;
  /// Rows: smallest sigma'_v0 of the layer [Pa], tag; from the surface down.
  std::vector<std::vector<double>> layers;
  /// Rows: tag, phi peak, residual [rad], c peak, residual [Pa], strain at peak, at residual [-].
  std::vector<std::vector<double>> strengths;

  // What the history knows, see for_history(); no settings.
  int frame = -1;      ///< index into FemHistory::times(), -1 for the gravity state
  int tailings = 168;  ///< element material tags
  int embankment = 167;
  int foundation = 170;
  std::vector<std::vector<double>> densities;  ///< rows: element material tag, density [kg/m3]

  SordoConfig();
};

/// With tags and densities of the materials of that name, and the frame. Throws InputError for a
/// name that the history does not have.
SordoConfig for_history(SordoConfig config, const FemHistory& history, int frame);

template <>
struct Schema<SordoConfig> {
  static constexpr std::string_view doc =
      "Transfer as the script of Sordo et al. (2024) does it, defects included.";
  static void describe(FieldVisitor& v, SordoConfig& c);
};

/// Throws InputError for a config that contradicts itself.
void check(const SordoConfig& config);

/// Four points per element with total stress, sigma_zz = 0. The history arrays are the script's
/// further columns: "strain_xx", "strain_yy", "gamma_xy", "epsilon_v", "r_u",
/// "pore_pressure_transfer", "material_id", "nstate_vars", "svars_0".."svars_6" and, for the runout
/// solver, "plastic_strain" (= svars_6). `notes` lists every defect. Same bits for any number of
/// threads. Throws InputError naming tags of elements and nodes, NumericsError (radial.hpp).
ParticleSet map_sordo2024(const FemHistory& history, const SordoConfig& config);

/// The same from states in memory; `shaking` null transfers the gravity state.
ParticleSet map_sordo2024(const QuadMesh& mesh, const FemFrame& gravity, const FemFrame* shaking,
                          const SordoConfig& config);

/// One line per defect that is reproduced: "S01 sigma_zz is zero: <effect>".
std::vector<std::string> sordo2024_defects();

}  // namespace flowslide
