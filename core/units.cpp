#include "core/units.hpp"

#include "core/check.hpp"
#include "core/conventions.hpp"

#include <array>
#include <charconv>
#include <cmath>
#include <limits>

namespace flowslide {
namespace {

struct Unit {
  std::string_view text;
  Dim dim;
  double factor;
};

// The first unit of each dimension is the SI one.
constexpr std::array kUnits = {
    Unit{"m", Dim::length, 1.0},
    Unit{"mm", Dim::length, 1e-3},
    Unit{"cm", Dim::length, 1e-2},
    Unit{"km", Dim::length, 1e3},
    Unit{"s", Dim::time, 1.0},
    Unit{"ms", Dim::time, 1e-3},
    Unit{"min", Dim::time, 60.0},
    Unit{"h", Dim::time, 3600.0},
    Unit{"kg", Dim::mass, 1.0},
    Unit{"t", Dim::mass, 1e3},
    Unit{"Pa", Dim::stress, 1.0},
    Unit{"kPa", Dim::stress, 1e3},
    Unit{"MPa", Dim::stress, 1e6},
    Unit{"GPa", Dim::stress, 1e9},
    Unit{"kg/m3", Dim::density, 1.0},
    Unit{"t/m3", Dim::density, 1e3},
    Unit{"g/cm3", Dim::density, 1e3},
    Unit{"m/s", Dim::velocity, 1.0},
    Unit{"cm/s", Dim::velocity, 1e-2},
    Unit{"mm/s", Dim::velocity, 1e-3},
    Unit{"km/h", Dim::velocity, 1.0 / 3.6},
    Unit{"m/s2", Dim::acceleration, 1.0},
    Unit{"cm/s2", Dim::acceleration, 1e-2},
    Unit{"g", Dim::acceleration, kGravity},
    Unit{"rad", Dim::angle, 1.0},
    Unit{"deg", Dim::angle, kPi / 180.0},
    Unit{"Hz", Dim::frequency, 1.0},
    Unit{"kHz", Dim::frequency, 1e3},
    Unit{"m3", Dim::volume, 1.0},
    Unit{"Pa s", Dim::viscosity, 1.0},
    Unit{"kPa s", Dim::viscosity, 1e3},
};

std::string_view trim(std::string_view s) {
  const auto first = s.find_first_not_of(" \t");
  if (first == std::string_view::npos) return {};
  return s.substr(first, s.find_last_not_of(" \t") - first + 1);
}

std::string example(Dim dim) {
  std::string all;
  for (const auto unit : known_units(dim)) all += (all.empty() ? "" : ", ") + std::string(unit);
  return all;
}

}  // namespace

std::string_view name(Dim dim) {
  constexpr std::array<std::string_view, 12> names = {
      "number",   "length",       "time",  "mass",      "stress", "density",
      "velocity", "acceleration", "angle", "frequency", "volume", "viscosity"};
  return names[static_cast<std::size_t>(dim)];
}

std::string_view si_unit(Dim dim) {
  for (const Unit& u : kUnits)
    if (u.dim == dim) return u.text;
  return {};
}

std::vector<std::string_view> known_units(Dim dim) {
  std::vector<std::string_view> units;
  for (const Unit& u : kUnits)
    if (u.dim == dim) units.push_back(u.text);
  return units;
}

double unit_factor(std::string_view unit, Dim dim) {
  for (const Unit& u : kUnits)
    if (u.text == unit && u.dim == dim) return u.factor;
  for (const Unit& u : kUnits) {
    if (u.text == unit)
      throw InputError(fmt::format("'{}' is a unit of {} ({} expected) use one of: {}", unit,
                                   name(u.dim), name(dim), example(dim)));
  }
  throw InputError(
      fmt::format("unknown unit '{}' ({} expected) use one of: {}", unit, name(dim), example(dim)));
}

namespace {

/// Whether a number that no double holds is below one: by the place of its first digit that is not
/// zero and its exponent.
bool is_small(std::string_view number) {
  double place = 0.0, exponent = 0.0;
  bool significant = false, fraction = false;
  std::size_t i = number.starts_with('-') ? 1 : 0;
  for (; i < number.size() && number[i] != 'e' && number[i] != 'E'; ++i) {
    significant = significant || (number[i] != '0' && number[i] != '.');
    if (number[i] == '.')
      fraction = true;
    else if (significant != fraction)
      place += significant ? 1.0 : -1.0;
  }
  const bool negative = i + 1 < number.size() && number[i + 1] == '-';
  for (++i; i < number.size(); ++i)
    if (number[i] >= '0' && number[i] <= '9') exponent = 10.0 * exponent + (number[i] - '0');
  return place + (negative ? -exponent : exponent) < 0.0;
}

}  // namespace

bool parse_number(std::string_view text, double& value, std::size_t& length) {
  std::size_t skip = 0;
  if (!text.empty() && text[0] == '+') skip = 1;
  if (skip == 1 && text.size() > 1 && text[1] == '-') return false;
  const char* first = text.data() + skip;
  const char* last = text.data() + text.size();
  const auto [end, error] = std::from_chars(first, last, value);
  if (error == std::errc::result_out_of_range) {
    // Too small for a double is zero; too large is infinite, which every range check refuses.
    const std::string_view digits(first, static_cast<std::size_t>(end - first));
    value = is_small(digits) ? 0.0 : std::numeric_limits<double>::infinity();
    if (digits[0] == '-') value = -value;
  } else if (error != std::errc()) {
    return false;
  }
  length = static_cast<std::size_t>(end - text.data());
  return true;
}

double parse_quantity(std::string_view text, Dim dim) {
  text = trim(text);
  double number = 0.0;
  std::size_t used = 0;
  if (!parse_number(text, number, used)) {
    throw InputError(fmt::format(
        "'{}' is not a number{}", text,
        dim == Dim::none ? ""
                         : fmt::format(" ({} expected, e.g. '1 {}')", name(dim), si_unit(dim))));
  }
  validate(std::isfinite(number), "'{}' is not a finite number", text);
  const std::string_view unit = trim(text.substr(used));
  validate(!unit.starts_with(','),
           "'{}' has ',' in a number (numbers have a decimal point) write '.'", text);
  if (dim == Dim::none) {
    if (unit == "%") return number / 100.0;
    validate(
        unit != "deg" && unit != "rad",
        "'{}' is an angle (a plain number is expected) a coefficient of friction is the tangent "
        "of the angle",
        text);
    validate(unit.empty(), "'{}' has a unit (a plain number is expected) write '{}'", text,
             text.substr(0, used));
    return number;
  }
  validate(!unit.empty(), "'{}' has no unit ({} expected, e.g. '{} {}')", text, name(dim), text,
           si_unit(dim));
  return number * unit_factor(unit, dim);
}

std::string to_text(double si_value, Dim dim) {
  std::array<char, 32> buffer{};
  const auto [end, error] = std::to_chars(buffer.data(), buffer.data() + buffer.size(), si_value);
  std::string text(buffer.data(), end);
  if (dim != Dim::none) text += " " + std::string(si_unit(dim));
  return text;
}

}  // namespace flowslide
