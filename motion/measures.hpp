#pragma once
#include "core/progress.hpp"
#include "model/ground_motion.hpp"

#include <vector>

/// Intensity measures of a ground motion; equations and sources in docs/theory/ground-motion.md.
/// Acceleration runs straight between samples, velocity and displacement start at zero. Arguments
/// must pass check(const GroundMotion&).
namespace flowslide {

double pga(const GroundMotion& motion);  ///< max |a| [m/s2]
double pgv(const GroundMotion& motion);  ///< max |v| [m/s]

/// Velocity at every sample, by the trapezoidal rule [m/s].
std::vector<double> velocity(const GroundMotion& motion);
/// Displacement at every sample; exact for acceleration that is straight between samples [m].

/// Arias intensity, pi / (2 g) times the integral of a^2 [m/s].
double arias_intensity(const GroundMotion& motion);
/// Time at which the share (0 to 1) of the Arias intensity is reached [s].
double arias_time(const GroundMotion& motion, double share);
/// Time between two shares of the Arias intensity, D5-95 by default [s].
double significant_duration(const GroundMotion& motion, double from = 0.05, double to = 0.95);
/// Cumulative absolute velocity, the integral of |a| [m/s].
double cumulative_absolute_velocity(const GroundMotion& motion);
/// Mean period of Rathje et al. (2004): mean of 1/f from 0.25 to 20 Hz, weighted with the squared
/// Fourier amplitude [s]. Throws InputError if the motion has nothing in that band.
double mean_period(const GroundMotion& motion);

/// Frequency below which a share (0 to 1) of the energy of the acceleration lies [Hz].
double frequency_below(const GroundMotion& motion, double share);

struct MotionMeasures {
  double pga = kUnset;    ///< [m/s2]
  double pgv = kUnset;    ///< [m/s]
  double arias = kUnset;  ///< [m/s]
  double d5_95 = kUnset;  ///< [s]
  double tm = kUnset;     ///< [s]
  double cav = kUnset;    ///< [m/s]
  double masi = kUnset;   ///< [m/s]
};
MotionMeasures measure(const GroundMotion& motion, const Progress& progress = {});

}  // namespace flowslide
