#pragma once
#include "core/check.hpp"

#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

/// Benchmarks: numbers on speed, and error against cost. Run by `flowslide bench`.
namespace flowslide {

enum class Better { higher, lower };

struct Measurement {
  std::string name;  ///< such as "mpm/2d/quadratic/mohr_coulomb/640000"
  double value = kUnset;
  std::string unit;  ///< such as "Mupdates/s/core"
  Better better = Better::higher;
  std::map<std::string, double> numbers;     ///< further numbers, keys with their units
  std::map<std::string, std::string> texts;  ///< further facts
};

struct BenchCase {
  std::string name;  ///< beginning of the names of its measurements
  std::string doc;   ///< one line
  std::vector<Measurement> (*run)();
  bool large = false;  ///< takes so much time or memory that it has to be asked for
};

/// Processor time of the calling thread [s]: what other programs take does not count.
double thread_seconds();

/// The cases that a list of names asks for: each name is the beginning of a case's name, or a
/// longer name that begins with it; no names ask for all. Large cases are asked for by their whole
/// name, or with `large`. Throws InputError for a name that fits nothing.
std::vector<BenchCase> select(std::span<const BenchCase> cases, std::span<const std::string> names,
                              bool large = false);

/// [{"name", "value", "unit", "better", ...}] with `numbers` and `texts` as further keys.
std::string measurements_json(std::span<const Measurement> measurements);
/// Heading and row of a table of 79 columns.
std::string measurement_heading();
std::string measurement_row(const Measurement& m);

}  // namespace flowslide
