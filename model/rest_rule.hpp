#pragma once

namespace flowslide {

/// When a flow counts as at rest: by its energy and by its front, both for `window`.
struct RestRule {
  double kinetic_share = 1e-4;  ///< of the largest kinetic energy [-]
  double runout_change = 0.1;   ///< of the front [m]
  double window = 5.0;          ///< [s]
};

}  // namespace flowslide
