#pragma once
#include "fem/config.hpp"
#include "model/history_material.hpp"
#include "model/section_mesh.hpp"
#include "model/zone.hpp"
#include "mpm/run/flow_config.hpp"
#include "report/config.hpp"
#include "transfer/map/map_config.hpp"
#include "transfer/zone/stop_config.hpp"
#include "transfer/zone/zone_config.hpp"
#include "workflows/engine/stage.hpp"

#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

/// Settings against each other and against the section, before anything runs. What cannot be is an
/// error, what is odd a warning; limits and reasons in docs/guide/checks.md.
namespace flowslide {

template <class... Args>
void refuse(Findings& found, fmt::format_string<Args...> text, Args&&... args) {
  found.errors.push_back(fmt::format(text, std::forward<Args>(args)...));
}
template <class... Args>
void warn(Findings& found, fmt::format_string<Args...> text, Args&&... args) {
  found.warnings.push_back(fmt::format(text, std::forward<Args>(args)...));
}

/// Smallest box around some soil [m].
struct Extent {
  double left = std::numeric_limits<double>::infinity();
  double right = -std::numeric_limits<double>::infinity();
  double bottom = std::numeric_limits<double>::infinity();
  double top = -std::numeric_limits<double>::infinity();
  [[nodiscard]] bool empty() const { return !(left < right && bottom < top); }
  [[nodiscard]] double height() const { return top - bottom; }
};

Extent extent_of(const QuadMesh& mesh);

/// What transfer.map makes points of.
struct Soil {
  Extent all, counted;        ///< counted: what counts for the runout
  Extent uncut;               ///< what would count without the box
  double area = 0.0;          ///< [m2]
  double largest = 0.0;       ///< area of its largest element [m2]
  std::vector<Vec2> centres;  ///< of its elements, inside the box
  std::vector<Vec2> feet;     ///< below them, as low as the element's lowest corner in the box
};

/// Throws InputError for a name that the section does not have.
Soil soil_of(const SectionMesh& section, const MapConfig& config,
             const std::vector<HistoryMaterial>& materials);

/// Rollers, outlet and ground of a runout against the soil, and a toe that a report gives.
void check_toe(double toe, const FlowConfig& flow, const Soil& soil, Findings& found);
void check_edges(const FlowConfig& flow, const Soil& soil, Findings& found);
/// What the box of the transfer leaves of the soil that counts.
void check_box(const MapConfig& map, const Soil& soil, Findings& found);
/// Loads on the surface against the weight of the soil.
void check_tractions(const FlowConfig& flow, const Soil& soil, Findings& found);
void check_ground(const FlowConfig& flow, const Soil& soil, Findings& found);
/// Gravity, friction, damping, the scheme, and when the flow rests or sleeps.
void check_scheme(const FlowConfig& flow, const Soil& soil, Findings& found);
/// Settings that another one makes idle.
void check_inert(const FlowConfig& flow, Findings& found);
void check_inert(const FemConfig& fem, Findings& found);
/// The length for which softening strains hold, where soil of the transfer softens.
void check_softening(const FlowConfig& flow, const MapConfig& map, const Soil& soil,
                     Findings& found);
/// Soil that hangs above the ground: all of it, or a part that has no soil below it either.
/// `height` is that of the ground at x [m], `setting` what gives it, `hint` where to look.
void check_hanging(const std::string& setting, const std::function<double(double)>& height,
                   const FlowConfig& flow, const Soil& soil, const std::string& hint,
                   Findings& found);
/// Opens the terrain file.
void check_terrain(const FlowConfig& flow, const Soil& soil, Findings& found);

/// Cells against the height of the soil and those of the transfer; memory for the points.
void check_cells(const FlowConfig& flow, const Soil& soil, Findings& found);
void compare_cells(const FlowConfig& flow, const MapConfig& map, Findings& found);
/// Points of the transfer in each cell of the flow.
void check_points(const FlowConfig& flow, const MapConfig& map, const Soil& soil, Findings& found);
/// `memory` in bytes; machine_memory() but for tests.
void check_memory(const MapConfig& map, const Soil& soil, double width, double memory,
                  Findings& found);

void check_densities(const std::vector<HistoryMaterial>& materials, Findings& found);
/// Earth pressure at rest out of the plane, of an import.
void check_k0(double k0, Findings& found);
/// Stiffness of the materials of a transfer.
void check_map_materials(const MapConfig& map, const std::vector<HistoryMaterial>& materials,
                         const Soil& soil, Findings& found);
/// What the transfer makes of stress, and errors that its audit would pass.
void check_transfer_rules(const MapConfig& map, Findings& found);
/// A box that holds nothing, elements inside the box without a material, and soil that can liquefy
/// without a law for it.
void check_map_names(const MapConfig& map, const SectionMesh& section,
                     const std::vector<HistoryMaterial>& materials,
                     const std::optional<ZoneConfig>& zone, Findings& found);

/// Whether the shaking can liquefy what may liquefy.
void check_liquefiable(const FemConfig& fem, const TransferRuleConfig& rule,
                       const SectionMesh& section, Findings& found);

/// How near soil has come to liquefying that did not: whether a safe dam or a wrong number is the
/// reason shows there. A sentence after a blank.
std::string how_near(const LiquefactionZone& zone, const RuConfig& r_u);

/// Soils and water of the finite elements.
void check_fem_soils(const FemConfig& fem, Findings& found);
void check_water(const FemConfig& fem, const QuadMesh& mesh, Findings& found);

/// Frequencies of a motion, as far as they are known before it runs.
struct MotionBand {
  std::optional<double> mean_period;  ///< [s]
  std::optional<double> highest;      ///< below which four fifths of its energy lie [Hz]
};
/// Elements over the height of the section, and in the waves of the motion; the base against the
/// soil on it.
void check_waves(const FemConfig& fem, const SectionMesh& section, const MotionBand& band,
                 Findings& found);

/// How the ends of the section hold it.
void check_sides(const FemConfig& fem, const QuadMesh& mesh, Findings& found);
/// How often a shaking is recorded, that ends at `end` and has a mean period, both [s] if known.
void check_recording(const FemConfig& fem, const QuadMesh& mesh, std::optional<double> end,
                     std::optional<double> mean_period, Findings& found);

/// Residual strength against the stress it belongs to.
void check_strength(const StrengthConfig& strength, Findings& found);
/// From which pore pressure soil has liquefied.
void check_r_u(const RuConfig& r_u, Findings& found);
/// The pond surface against the soil that can liquefy.
void check_pond(const TransferRuleConfig& rule, const QuadMesh& mesh,
                const std::vector<HistoryMaterial>& materials, Findings& found);
/// The level of the pond in a report against the section, and the pond surface of the zone if
/// known.
void check_freeboard(double pond, const QuadMesh& mesh, std::optional<double> pond_surface,
                     Findings& found);
/// A named part of a report that has no outline, or holds nothing of a section that is known.
void check_region(const std::string& name, const ReportRegion& region, const QuadMesh& mesh,
                  Findings& found);
/// A transfer at a given time against the end of the shaking [s]; `above` is the path of the
/// rule's settings, with its dot.
void check_transfer_time(const TransferRuleConfig& rule, double end, std::string_view above,
                         Findings& found);
/// Residuals of balances from which a report warns.
void check_limits(const ReportConfig& report, Findings& found);
/// Settings of fem.run's stop_at_transfer that transfer.zone has otherwise.
void compare_transfer_rules(const StopAtTransferConfig& stop, const ZoneConfig& zone,
                            Findings& found);

/// A section of impossible size, and nodes far from all others.
void check_size(const QuadMesh& mesh, Findings& found);

}  // namespace flowslide
