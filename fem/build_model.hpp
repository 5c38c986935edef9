#pragma once
#include "fem/config.hpp"
#include "fem/solver.hpp"
#include "model/history_material.hpp"
#include "model/section_mesh.hpp"

namespace flowslide::fem {

/// A model of a section. Free-field columns are appended behind the nodes and elements of the
/// section, whose numbers stay. Needs the edge sets "base", "right", "surface" and "left". Throws
/// InputError, for instance for a material that the settings or the mesh do not know.
Model build_model(const SectionMesh& section, const FemConfig& config);

/// What the materials of a section are to later stages, from the settings of the same names. Throws
/// InputError for a material that the settings do not know.
std::vector<HistoryMaterial> history_materials(const SectionMesh& section, const FemConfig& config);

/// Level of the water table at x [m].
double water_level(const WaterConfig& water, double x);

/// Factors of mass and stiffness that the settings come to.
Damping rayleigh(const FemDampingConfig& c);

}  // namespace flowslide::fem
