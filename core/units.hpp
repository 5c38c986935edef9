#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace flowslide {

/// Physical dimension of a number that a user writes.
enum class Dim {
  none,          ///< a bare number; a unit is an error
  length,        ///< m
  time,          ///< s
  mass,          ///< kg
  stress,        ///< Pa
  density,       ///< kg/m3
  velocity,      ///< m/s
  acceleration,  ///< m/s2
  angle,         ///< rad
  frequency,     ///< Hz
  volume,        ///< m3
  viscosity,     ///< Pa s
};

/// "stress", "length", ... as used in messages and in the manual.
std::string_view name(Dim dim);
/// SI unit of the dimension, "Pa", "m", ...; empty for Dim::none.
std::string_view si_unit(Dim dim);
/// Units a user may write for the dimension, SI first.
std::vector<std::string_view> known_units(Dim dim);

/// "20 MPa" -> 2e7. Demands a unit unless dim is none; the number must be finite.
/// Throws InputError with the problem and a suggestion, without a location.
double parse_quantity(std::string_view text, Dim dim);

/// Factor from the unit to SI, for declared units of data files ("kPa" -> 1e3). Throws InputError.
double unit_factor(std::string_view unit, Dim dim);

/// Shortest text that reads back to the same double, followed by the SI unit: "2e+07 Pa".
std::string to_text(double value, Dim dim);

/// Locale-free: reads the longest number at the start; false if there is none. Accepts "+1", ".5",
/// "5.", "1e-005", denormals; "nan" and "inf" are read as such.
bool parse_number(std::string_view text, double& value, std::size_t& length);

}  // namespace flowslide
