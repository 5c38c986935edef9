#pragma once
#include "model/history.hpp"
#include "model/zone.hpp"
#include "transfer/zone/columns.hpp"
#include "transfer/zone/sliding.hpp"
#include "transfer/zone/zone_config.hpp"
#include "transfer/zone/zone_r_u.hpp"

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace flowslide {

/// What part of the mesh counts for what.
struct ZoneParts {
  std::vector<std::int32_t> section;  ///< elements inside the box
  std::vector<std::int32_t> soil;     ///< liquefiable ones among them
  std::vector<std::uint8_t> in_soil;  ///< flag per element, the same
  std::vector<std::int32_t> base_nodes;
};

/// Throws InputError for settings that do not fit the section: names, box, windows, base nodes.
ZoneParts zone_parts(const QuadMesh& mesh, const std::vector<HistoryMaterial>& materials,
                     const TransferRuleConfig& config);

/// Makes the scalars of ZoneHistory from frames as they come, so that the rule of the transfer time
/// can be asked while a record grows (docs/theory/liquefaction-zone.md).
class ZoneRecorder {
 public:
  /// Throws InputError: settings that do not fit the section, a gravity state with unset numbers.
  ZoneRecorder(const QuadMesh& mesh, const std::vector<HistoryMaterial>& materials,
               const FemFrame& gravity, const TransferRuleConfig& config);
  /// The next frame. Throws InputError for state that is not finite where it is needed.
  void append(const FemFrame& frame);

  [[nodiscard]] const QuadMesh& mesh() const { return mesh_; }
  [[nodiscard]] const ZoneParts& parts() const { return parts_; }
  [[nodiscard]] const RuReference& reference() const { return reference_; }
  [[nodiscard]] const ZoneHistory& history() const { return history_; }
  [[nodiscard]] TransferChoice choose() const;
  /// First instant of failure, by the rule of `when: automatic`.
  [[nodiscard]] std::optional<std::size_t> onset() const;
  /// Instant at which 95 % of the squared velocity of the base has passed, in time.
  [[nodiscard]] std::size_t strong_shaking_end() const;
  /// Mean squared velocity of the base from then to the end of the record, over that of the 90 %
  /// before; small where the record holds the whole motion, 1 where it breaks off.
  [[nodiscard]] double motion_left() const;
  /// Whether the choice is final: docs/theory/liquefaction-zone.md, "Stopping by the rule".
  [[nodiscard]] bool is_settled() const;

 private:
  void check_finite(const FemFrame& frame) const;
  [[nodiscard]] std::vector<double> base_motion() const;  ///< integral of base_kinetic_
  [[nodiscard]] double yielded_share(std::span<const StrainIncrement<2>> strain) const;
  void append_depths(std::span<const Vec2> positions, std::span<const double> r_u);
  QuadMesh mesh_;
  TransferRuleConfig config_;
  ZoneParts parts_;
  RuReference reference_;
  std::vector<double> mass_;  ///< of the elements of the section [kg/m]
  NodeNeighbours adjacent_;
  std::vector<SoilColumn> columns_;
  double section_mass_;  ///< sum of mass_ [kg/m]
  std::vector<StrainIncrement<2>> strain_at_rest_;
  SlidingEnergy sliding_;
  ZoneHistory history_;
  std::vector<double> base_kinetic_;  ///< KineticEnergy::base of each frame
  TransferEvidence evidence_;
};

}  // namespace flowslide
