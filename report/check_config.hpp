#pragma once
#include "core/check.hpp"
#include "report/config.hpp"

namespace flowslide {

/// Relations between settings that the ranges of the schema cannot express. Throws InputError.
inline void check(const ReportConfig& c) {
  validate(c.stood < c.moved,
           "stood: {} m is not below moved: {} m (no section could be said to have deformed) give "
           "a smaller stood",
           c.stood, c.moved);
}

}  // namespace flowslide
