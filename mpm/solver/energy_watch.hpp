#pragma once
#include "model/mpm_history.hpp"

/// Sees an unstable scheme in the balance of energy, which closes whatever happens: energy that
/// comes from nowhere is booked as dissipation below zero. docs/theory/mpm.md, section Balances
namespace flowslide::mpm {

struct EnergyWatch {
  double brought = 0.0;     ///< at the start and by gravity and loads, the most so far [J]
  double dissipated = 0.0;  ///< the most so far [J]

  /// Before the first sample: kinetic and stored energy at the start, and what the first steps may
  /// be wrong by [J].
  void begin(double kinetic, double recoverable, double noise) {
    brought = kinetic + recoverable + noise;
  }
  /// Looks at a row of the time series; `elastic` tells that no law of the run dissipates. Throws
  /// NumericsError naming time and energies.
  void look(const MpmSample& now, bool elastic);

 private:
  double gravity_ = 0.0, load_ = 0.0;  ///< largest work of either so far [J]
};

}  // namespace flowslide::mpm
