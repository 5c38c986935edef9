#pragma once
#include <complex>
#include <span>
#include <vector>

/// Discrete Fourier transforms of real samples, for lengths with small prime factors. A prime
/// factor p costs p operations per sample.
namespace flowslide {

/// c_k = sum_j x_j exp(-2 pi i j k/n) for k = 0 ... n/2.
std::vector<std::complex<double>> half_spectrum(std::span<const double> x);

/// The n samples with this half spectrum of n/2 + 1 numbers: its inverse.
std::vector<double> samples_of(std::span<const std::complex<double>> half, std::size_t n);

}  // namespace flowslide
