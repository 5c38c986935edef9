#pragma once
#include "core/progress.hpp"
#include "model/history.hpp"
#include "model/particle_set.hpp"
#include "model/zone.hpp"
#include "transfer/map/map_config.hpp"
#include "transfer/map/map_groups.hpp"
#include "transfer/seeding/seed.hpp"

#include <vector>

/// Fields of the finite elements at the points. Theory: docs/theory/transfer.md, "Fields".
namespace flowslide {

/// Motion of the base, removed from everything.
struct BaseMotion {
  Vec2 displacement{};
  Vec2 velocity{};
};

/// Zero if the config keeps the base motion. Nodes outside the box in the reference configuration,
/// such as free-field columns, are no candidates unless none is inside.
BaseMotion base_motion(const QuadMesh& mesh, const FemFrame& frame, const Box& box,
                       const MapConfig& config);

/// The transferred state relative to the base.
struct MappedState {
  const QuadMesh& mesh;
  const FemFrame& gravity;
  const FemFrame& frame;  ///< displacement and velocity as recorded
  const LiquefactionZone& zone;
  std::vector<Vec2> positions;  ///< nodes, deformed, base motion removed [m]
  BaseMotion base;
  bool at_rest = false;  ///< `frame` is the gravity state
};

struct MapCounts {
  int widened = 0;
  int nearest = 0;
};

/// Everything but id and materials: motion by the shape functions of each share (mass-weighted
/// velocity, so that momentum is kept), stress by moving least squares from element centres of the
/// family, before any return; history "plastic_strain", "strength", "soft_strength" [Pa], "r_u".
/// Strengths are 0 on points whose law does not read them.
ParticleSet map_fields(const MappedState& state, const SeedSet& seeds, const MapGroups& groups,
                       const MapConfig& config, const Progress& progress, MapCounts& counts);

}  // namespace flowslide
