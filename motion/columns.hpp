#pragma once
#include "motion/record.hpp"
#include "motion/record_text.hpp"

namespace flowslide {

/// Text or CSV columns separated by blanks, commas or semicolons: acceleration, or time and
/// acceleration. Lines of words and lines that start with #, %, // or ! are skipped, before the
/// first row only. The time column [s] must be uniform; the step is the mean one, so that times
/// with few digits do no harm. Throws InputError with file:line.
Record parse_columns(const RecordText& text, const RecordFormat& format);

}  // namespace flowslide
