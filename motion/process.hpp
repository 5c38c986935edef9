#pragma once
#include "core/progress.hpp"
#include "model/ground_motion.hpp"

#include <array>
#include <string_view>

/// Processing of ground motions. Each function returns a new motion whose origin tells what was
/// done; order and reasons in docs/guide/motions.md. Throws InputError for what makes no sense.
namespace flowslide {

/// Samples that a motion may have here, so that every step of its processing takes seconds.
inline constexpr double kMostSamples = 5e6;

/// The same shape with max |a| equal to `pga` [m/s2] to the last bit.
GroundMotion scaled_to_pga(const GroundMotion& motion, double pga);

/// To what a baseline polynomial is fitted by least squares.
enum class BaselineFit {
  acceleration,  ///< subtract it from the acceleration
  velocity,      ///< fit the velocity with v(0) = 0, subtract the derivative from the acceleration
};
inline constexpr std::array<std::string_view, 2> kBaselineFits{"acceleration", "velocity"};

/// Takes a polynomial of `degree` (0 constant, 1 linear, up to 8) off the acceleration.
GroundMotion baseline_corrected(const GroundMotion& motion, int degree,
                                BaselineFit fit = BaselineFit::acceleration);

enum class ResampleMethod {
  linear,        ///< straight between samples, as finite-element programs read motions; no filter
  band_limited,  ///< windowed sinc that cuts at the lower of the two Nyquist frequencies
};
inline constexpr std::array<std::string_view, 2> kResampleMethods{"linear", "band_limited"};

/// Samples at 0, dt, 2 dt, ... up to the end of the motion [s].
GroundMotion resampled(const GroundMotion& motion, double dt, ResampleMethod method,
                       const Progress& progress = {});

}  // namespace flowslide
