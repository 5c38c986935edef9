#pragma once
#include "core/benchmark.hpp"

namespace flowslide::fem {

/// Sub-steps of PM4Sand per second and core, and the stress error, for pairs of
/// `max_strain_increment` and `tolerance`.
std::vector<Measurement> measure_pm4sand();

/// Element updates of the explicit step per second and core, before and after liquefaction.
std::vector<Measurement> measure_step();

}  // namespace flowslide::fem
