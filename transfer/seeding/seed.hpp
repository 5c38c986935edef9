#pragma once
#include "core/progress.hpp"
#include "model/mesh.hpp"
#include "transfer/seeding/polygon.hpp"

#include <array>
#include <cstdint>
#include <vector>

/// Where material points are placed, and how much volume and mass each one carries. Volume is that
/// of the deformed mesh, mass that of the reference mesh: both are conserved to rounding. Theory:
/// docs/theory/transfer.md, "Seeding".
namespace flowslide {

/// What a point takes while it is seeded and mapped: fragments, pieces, weights of the stress,
/// fields [bytes].
inline constexpr double kBytesPerSeededPoint = 1500.0;

/// The part of a deformed mesh that becomes material points.
struct SeedDomain {
  const QuadMesh& mesh;
  const std::vector<Vec2>& positions;  ///< nodes, deformed [m]
  std::vector<double> density;         ///< elements, in the reference configuration [kg/m3]
  std::vector<std::int32_t> group;     ///< elements; one point never mixes groups; -1: not seeded
  Box box;                             ///< only what lies inside becomes points
};

/// Share of one element in one point.
struct SeedPiece {
  std::int32_t element = 0;
  std::array<double, 4> shape{};  ///< shape functions of the element at the centroid of the share
  double volume = 0.0;            ///< [m3] per metre of width
  double mass = 0.0;              ///< [kg] per metre of width
};

struct Seed {
  Vec2 position{};
  double volume = 0.0;  ///< [m3] per metre of width
  double mass = 0.0;    ///< [kg] per metre of width
  std::int32_t group = 0;
  std::int32_t first_piece = 0;
  std::int32_t num_pieces = 0;
};

struct SeedSet {
  std::vector<Seed> seeds;
  std::vector<SeedPiece> pieces;  ///< in the order of the seeds; the largest of a seed comes first
  int slivers_merged = 0;         ///< pieces below the limit, given to a neighbour
  int slivers_kept = 0;           ///< pieces below the limit without a neighbour of their group
  int moved_inside = 0;           ///< centroids that fell outside the material and were moved
  int split_elements = 0;         ///< elements with a re-entrant corner, seeded as two triangles
};

struct LatticeOptions {
  double spacing = 0.0;           ///< edge of a lattice cell [m]
  Vec2 origin{};                  ///< a corner of a lattice cell [m]
  double sliver_fraction = 0.01;  ///< of a lattice cell; smaller pieces join a neighbour
};

/// One point per lattice cell and group, at the centroid of the clipped area, ordered by cell (rows
/// from below, then columns) and group. Throws InputError for folded elements, naming them, and for
/// more points than fit in memory.
SeedSet seed_lattice(const SeedDomain& domain, const LatticeOptions& options,
                     const Progress& progress = {});

/// order x order points per element at the Gauss points, with the exact Jacobian as weight, in
/// the order of the elements. Elements count as inside the box by their deformed centroid; order is
/// 1 to 4. Throws InputError for folded elements.
SeedSet seed_gauss(const SeedDomain& domain, int order);

/// Share of an element's deformed area inside the box, 0 to 1.
double share_inside(const SeedDomain& domain, std::size_t element);

}  // namespace flowslide
