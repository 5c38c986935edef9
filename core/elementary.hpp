#pragma once

/// Elementary functions whose results have the same bits on every machine: sums, products and
/// divisions in a fixed order, without fused multiply-add. The C library has several versions of
/// each and takes the one that suits the processor (docs/adr/0002-instruction-set.md). Square roots
/// and rounding are exact everywhere and stay those of the library.
/// Errors are in units in the last place, the largest that a few million random arguments gave.
namespace flowslide {

[[nodiscard]] double exp(double x) noexcept;  ///< below 1; subnormal results to one of theirs
[[nodiscard]] double log(double x) noexcept;  ///< below 1; NaN for x < 0, -infinity at 0
/// x^y for x >= 0, below 1; NaN for x < 0 unless y is 0.
[[nodiscard]] double pow(double x, double y) noexcept;
/// Products of n factors, from left to right.
[[nodiscard]] double pow(double x, int n) noexcept;

/// Angles up to 5e8 rad; NaN beyond, where a double no longer says which angle is meant.
[[nodiscard]] double sin(double x) noexcept;              ///< below 1
[[nodiscard]] double cos(double x) noexcept;              ///< below 1
[[nodiscard]] double tan(double x) noexcept;              ///< below 2
[[nodiscard]] double asin(double x) noexcept;             ///< below 2; NaN beyond -1 and 1
[[nodiscard]] double atan2(double y, double x) noexcept;  ///< below 2, of finite arguments

/// sqrt(x^2 + y^2) without overflow on the way, below 2.
[[nodiscard]] double hypot(double x, double y) noexcept;

}  // namespace flowslide
