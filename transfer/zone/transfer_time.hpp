#pragma once
#include "config/schema.hpp"
#include "model/zone.hpp"

#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

/// The moment at which finite elements hand over to material points
/// (docs/theory/liquefaction-zone.md, section 5).
namespace flowslide {

enum class TransferWhen { automatic, gravity, end, at };
inline constexpr std::array<std::string_view, 4> kTransferWhens{"automatic", "gravity", "end",
                                                                "at"};

enum class EnergyFrame { sliding, relative, absolute };
inline constexpr std::array<std::string_view, 3> kEnergyFrames{"sliding", "relative", "absolute"};

enum class JacobianPoint { gauss, centre };
inline constexpr std::array<std::string_view, 2> kJacobianPoints{"gauss", "centre"};

/// Parameters of `when: automatic`, also of the recorded Q.
struct AutomaticTransfer {
  EnergyFrame energy = EnergyFrame::sliding;
  double smoothing = 1.0;    ///< length of the trailing mean of velocity or energy [s]
  double growth = 2.0;       ///< onset: energy above this multiple of the envelope [-]
  double sustain = 1.0;      ///< onset: for this long beyond the smoothing, larger at its end [s]
  double development = 0.9;  ///< full development: share of the largest depth [-]
  double strain_threshold = 0.03;  ///< eps_q from which elements count in Q [-]
  double distortion_limit = 0.97;  ///< excessive distortion: Q below [-]
  JacobianPoint jacobian = JacobianPoint::gauss;
  double between = 0.5;  ///< 0 at full failure development, 1 at excessive distortion
};

struct TransferTimeConfig {
  TransferWhen when = TransferWhen::automatic;
  std::optional<double> at{};  ///< [s], with `when: at`
  AutomaticTransfer automatic{};
};

/// `at` is given with `when: at` and only then. Throws InputError.
void check(const TransferTimeConfig& config);

struct TransferChoice {
  int frame = -1;      ///< index into history.time, -1 for the gravity state
  double time = 0.0;   ///< [s]
  std::string reason;  ///< one sentence
};

/// Deviatoric strain of the shaking from which soil counts as yielded: what has undrained or dense
/// sand past its peak, 5 % in simple shear [-].
inline constexpr double kYieldStrain = 0.03;

/// What the rule compares the energy of the section with, per frame.
struct TransferEvidence {
  /// SlidingEnergy::Values::base with `energy: sliding`, else KineticEnergy::base [J/m]
  std::vector<double> base_energy{};
  /// Share of the section's mass that has yielded [-]
  std::vector<double> yielded{};
};

/// Applies the rule to the recorded scalars.
/// Throws InputError if the history has no frames or the time is outside the record.
TransferChoice choose_transfer(const TransferTimeConfig& config, const ZoneHistory& history,
                               const TransferEvidence& evidence);

/// Whether no frames that follow can change the choice; with `when: automatic` that is so when Q
/// has fallen below its limit and it is known whether the energy had risen before. Never with
/// `when: end`, nor while the choice is the last frame for want of distortion.
bool is_settled(const TransferTimeConfig& config, const ZoneHistory& history,
                const TransferEvidence& evidence);

/// Mean of the samples in (t_i - length, t_i], for each i.
std::vector<double> trailing_mean(std::span<const double> time, std::span<const double> value,
                                  double length);

/// A failure as the kinetic energy tells it: it leaves its pre-failure envelope, and outgrows it.
struct EnergyOnset {
  std::size_t begin = 0;  ///< above the envelope from here on until it has outgrown it
  std::size_t grown = 0;  ///< first sample above `growth` times the envelope for good
  double energy = 0.0;    ///< then, trailing mean [J/m]
  double envelope = 0.0;  ///< then [J/m]
};
std::optional<EnergyOnset> find_onset(const AutomaticTransfer& rule, const ZoneHistory& history,
                                      const TransferEvidence& evidence);

/// Where the energy rises above `growth` times the envelope to stay there until the record ends,
/// for however short a time.
std::optional<EnergyOnset> rising_at_end(const AutomaticTransfer& rule, const ZoneHistory& history,
                                         const TransferEvidence& evidence);

template <>
struct Schema<AutomaticTransfer> {
  static constexpr std::string_view doc = "Criteria of the automatic transfer time.";
  static void describe(FieldVisitor& v, AutomaticTransfer& c);
};

}  // namespace flowslide
