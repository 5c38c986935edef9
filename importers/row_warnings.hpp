#pragma once
#include "importers/recorder_times.hpp"

#include <span>
#include <string>
#include <vector>

namespace flowslide {

/// What the rows that recorders have in common leave out, and times that no shaking has: a recorder
/// that ended before the others, rows lost in its middle, times printed with too few digits, an
/// interval that is another unit's.
std::vector<std::string> row_warnings(std::span<const FileTimes> files, const AlignedRows& aligned);

}  // namespace flowslide
