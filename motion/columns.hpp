#pragma once
#include "motion/record.hpp"
#include "motion/record_text.hpp"

namespace flowslide {

/// A comment, or a line whose first word starts no number: what may stand before the first row.
bool is_heading_line(std::string_view line);

/// Text or CSV columns separated by blanks, commas or semicolons: acceleration, or time and
/// acceleration. Lines of words and lines that start with #, %, // or ! are skipped, before the
/// first row only; a unit of acceleration that they name must be the declared one. The time column
/// [s] must be uniform; the step is the mean one, so that times with few digits do no harm. Throws
/// InputError with file:line.
Record parse_columns(const RecordText& text, const RecordFormat& format);

}  // namespace flowslide
