#pragma once
#include "fem/config.hpp"
#include "fem/solver.hpp"
#include "model/history.hpp"
#include "model/section_mesh.hpp"

#include <optional>
#include <string>

/// What a run tells about a state of its solver.
namespace flowslide::fem {

/// The state on the first `nodes` nodes and `elements` elements, those of the section.
void fill(FemFrame& frame, const Solver& s, std::size_t nodes, std::size_t elements);

/// Water at rest that stands far below the table is easily overlooked: layers drain each other by
/// their permeabilities, and the soil is stronger for it.
std::optional<std::string> drained_note(const SectionMesh& section, const FemConfig& config,
                                        const Solver& s);

/// Of the nodes against the mean of those at the base [m].
double largest_displacement(const FemFrame& frame, const std::vector<std::int32_t>& base);

}  // namespace flowslide::fem
