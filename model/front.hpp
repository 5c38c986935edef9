#pragma once
#include <array>
#include <cstddef>
#include <span>
#include <string_view>
#include <vector>

/// How far a flow has come: the one definition of every front and height that the program names.
/// docs/theory/mpm.md, section Measures of the runout.
namespace flowslide {

/// Rank of the point that marks the front of the case study (Sordo, Rathje & Kumar 2025): a handful
/// of detached points must not.
inline constexpr std::size_t kFrontRank = 5;

/// Shares of the counted mass that lie beyond the other fronts. The case study had some 7,400
/// points, so five of them are this share whatever the number of points here.
inline constexpr double kEqualMassShare = 5.0 / 7400.0;
inline constexpr std::array<double, 4> kFrontShares{kEqualMassShare, 0.005, 0.01, 0.05};
inline constexpr double kHeightShare = 0.005;

/// A point seen along one axis.
struct Place {
  double at;    ///< [m]
  double mass;  ///< [kg] > 0
};

/// The place beyond which at most `share` of the mass lies, for every share (ascending, 0 to 1):
/// that of the point with which more than the share is reached. Reorders `points`; NaN without any.
void places_beyond(std::span<Place> points, std::span<const double> shares, std::span<double> out);

struct Fronts {
  double fifth = 0.0;       ///< of the kFrontRank-farthest point, or of the last if there are fewer
  double equal_mass = 0.0;  ///< beyond it: kEqualMassShare of the mass
  double q995 = 0.0;        ///< 0.5 % of the mass
  double q99 = 0.0;         ///< 1 %
  double q95 = 0.0;         ///< 5 %
};

/// All zero without points. Reorders `points`.
Fronts fronts(std::span<Place> points);

/// Level above which kHeightShare of the mass lies; `points` along the upward axis.
double height(std::span<Place> points);

}  // namespace flowslide
