#pragma once
#include "mpm/run/flow_config.hpp"
#include "mpm/run/load.hpp"

/// The scene of the speed benchmarks: a square or cubic body of soil that collapses under its own
/// weight from a state near failure, with two points per cell and direction, off their lattice.
namespace flowslide::mpm {

enum class BenchLaw { linear_elastic, mohr_coulomb, residual_strength };
std::string_view law_name(BenchLaw law);

template <int Dim>
Simulation<Dim> bench_column(int points_per_side, BasisKind basis, BenchLaw law);

/// Bytes that a step with apic must load and store per point: the arrays of the points once,
/// windows written and read, nodes written and read.
template <int Dim>
double bytes_per_update(const Simulation<Dim>& s, BenchLaw law);

}  // namespace flowslide::mpm
