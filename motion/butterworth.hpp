#pragma once
#include "core/progress.hpp"
#include "model/ground_motion.hpp"

#include <array>
#include <optional>
#include <string_view>

namespace flowslide {

enum class FilterPhase {
  zero,    ///< forward and backward: no delay, -6 dB at the corners, begins before its cause
  causal,  ///< forward: delay that depends on frequency, -3 dB at the corners
};
inline constexpr std::array<std::string_view, 2> kFilterPhases{"zero", "causal"};

/// Butterworth high-pass and low-pass, each of `order`, one after the other; a corner left out does
/// not filter. Given both, a band-pass.
struct BandPass {
  std::optional<double> high_pass = {};  ///< lower corner [Hz]
  std::optional<double> low_pass = {};   ///< upper corner [Hz], below the Nyquist frequency
  int order = 4;                         ///< of each corner and pass, 1 to 10
  FilterPhase phase = FilterPhase::zero;
  /// Keep the 1.5 order / corner seconds of padding (Converse and Brady 1992) before and after,
  /// into which the filter rings: without them velocity and displacement drift again (Boore 2005).
  bool keep_padding = false;
};

/// Throws InputError for corners that are no band of this motion.
GroundMotion filtered(const GroundMotion& motion, const BandPass& band,
                      const Progress& progress = {});

}  // namespace flowslide
