#pragma once
#include "core/benchmark.hpp"

namespace flowslide::mpm {

/// Point updates per second and core of whole steps, for every law and size.
template <int Dim>
std::vector<Measurement> measure_quadratic();
template <int Dim>
std::vector<Measurement> measure_linear();

/// Wall time of a step of the dam as a valley with two million points on all cores, and the memory
/// it takes.
std::vector<Measurement> measure_valley();

/// Updates per second and core of ten million points in plane strain and two million in space,
/// beside the larger size of the rows above, and the peak memory per point from filling to
/// stepping. A minute and 5 GB.
std::vector<Measurement> measure_large();

/// Error against processor time: a moving, swinging bar, four cell sizes for each line of
/// basis and transfer. Lines that go unstable have no row for the cells where they do.
std::vector<Measurement> work_precision();

/// Error of a dry column's front against processor time, for each transfer of velocity.
std::vector<Measurement> front_precision();

}  // namespace flowslide::mpm
