#pragma once
#include "mpm/grid/grid.hpp"
#include "mpm/grid/points.hpp"

#include <array>
#include <cstdint>
#include <vector>

/// Tiles that have come to rest, or that the flow has not reached yet, are left out of the step
/// until something moves near them. docs/theory/mpm.md, section Sleep
namespace flowslide::mpm {

template <int Dim>
struct Sleep {
  double speed = 0.0;  ///< slower is quiet [m/s]; 0: nothing sleeps
  double after = 1.0;  ///< quiet for so long [s]
  // Per point, by Points::index.
  std::array<std::vector<double>, Dim> place;  ///< where it was when last seen to move [m]
  std::vector<double> since;                   ///< when that was [s]
  std::vector<std::int32_t> asleep;            ///< 1: its tile sleeps
  double next_look = 0.0;                      ///< [s]
  std::int64_t count = 0;                      ///< points asleep

  [[nodiscard]] bool on() const { return speed > 0.0; }
  /// Of a tile, all of whose points sleep or none.
  [[nodiscard]] bool sleeps(const Points<Dim>& points, const Tile<Dim>& tile) const {
    return on() && asleep[points.index[tile.first]] != 0;
  }
};

/// What a change of the tiles that sleep does beside.
template <int Dim>
struct SleepChange {
  bool woken = false;                 ///< points woke
  std::array<double, Dim> impulse{};  ///< that stopped those that fell asleep [N s]
};

/// Puts tiles to sleep all of whose points, and all of whose neighbours' points, have moved less
/// than speed x after for the time `after`, and wakes the others. Those in `restless` (point index)
/// count as moving. Called when points were sorted.
template <int Dim>
SleepChange<Dim> look_for_sleep(double now, const std::vector<std::int32_t>& restless,
                                const Grid<Dim>& grid, const Tiling<Dim>& tiling,
                                Points<Dim>& points, Sleep<Dim>& sleep);

}  // namespace flowslide::mpm
