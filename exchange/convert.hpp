#pragma once
#include "motion/record.hpp"

#include <string>
#include <vector>

/// Files of this program and of others made into each other.
namespace flowslide {

struct ConvertOptions {
  std::string in, out;
  RecordFormat format;  ///< of motions that do not say it
};

/// What a conversion left out or found odd.
struct Converted {
  std::vector<std::string> notes = {}, warnings = {};
};

/// Makes `out` from `in`; the kind of `out` is told by its ending, or it is a folder. Throws
/// InputError for a pair that is not known, FileError.
Converted convert(const ConvertOptions& options);

/// One line per conversion: "\n  particles.h5 -> NAME.csv, particles of CB-Geo MPM".
std::string known_conversions();

}  // namespace flowslide
