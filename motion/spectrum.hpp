#pragma once
#include "core/progress.hpp"
#include "model/ground_motion.hpp"

#include <span>
#include <vector>

/// Response of an elastic oscillator to a ground motion, u'' + 2 zeta omega u' + omega^2 u = -a.
namespace flowslide {

/// Where the peak of the response is looked for. Both advance the oscillator exactly for
/// acceleration that is straight between samples (Nigam and Jennings 1969).
enum class PeakSearch {
  samples,  ///< at the samples, as in most published spectra; low by up to 1 - cos(pi dt / T)
  between,  ///< also on the cubic through u and u' of neighbouring samples
};

/// Largest |u| [m], during the motion and the free vibration after it.
double spectral_displacement(const GroundMotion& motion, double period, double damping = 0.05,
                             PeakSearch search = PeakSearch::samples);

/// PSA = omega^2 max |u| [m/s2] at each period [s]; a period of zero gives PGA. Damping is a share
/// of the critical one, 0 <= damping < 1. Throws InputError.
std::vector<double> pseudo_acceleration(const GroundMotion& motion, std::span<const double> periods,
                                        double damping = 0.05,
                                        PeakSearch search = PeakSearch::samples,
                                        const Progress& progress = {});

/// Modified acceleration spectrum intensity: integral of PSA(T, 5 %) over T from 0.1 to 1.5 s,
/// trapezoidal rule at a spacing of 0.01 s [m/s].
double masi(const GroundMotion& motion, PeakSearch search = PeakSearch::samples,
            const Progress& progress = {});

}  // namespace flowslide
