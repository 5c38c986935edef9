#pragma once
#include "mpm/solver/checkpoint.hpp"

#include <string>

namespace flowslide::mpm {

/// What a checkpoint has that no run can have, or "". Its checksum says that its bytes are those
/// that were written, not that this program wrote them: sizes and indices that the steps rely on
/// are looked at before they are used.
/// @param points number of those the run started from
template <int Dim>
std::string find_misfit(const Simulation<Dim>& s, const RunState& run, std::size_t points);

}  // namespace flowslide::mpm
