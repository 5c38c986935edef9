#pragma once
#include "mpm/grid/grid.hpp"
#include "mpm/kernels/momentum.hpp"
#include "mpm/walls/absorbing.hpp"
#include "mpm/walls/boundary.hpp"

#include <cstdint>
#include <vector>

/// Contact with the ground and walls: impulses where their surfaces cross the grid lines, spread
/// over the nodes of the line as a pressure on the surface would be. docs/theory/contact.md
namespace flowslide::mpm {

enum class WallKind {
  ground,     ///< pushes, with Coulomb friction
  roller,     ///< holds both ways, without friction
  absorbing,  ///< a dashpot of an absorbing plane
};

/// A point of a wall. It acts on the contact nodes [first, last) of Contact::node and ::weight.
template <int Dim>
struct WallPoint {
  std::array<double, Dim> normal{};  ///< unit, into the soil
  WallKind kind = WallKind::ground;
  double friction = 0.0;      ///< of `ground`: Coulomb coefficient [-]
  std::int32_t dashpot = -1;  ///< of `absorbing`: into Absorbing::dashpots
  std::int32_t first = 0, last = 0;
  std::int32_t touching = 0;  ///< entries [first, touching) lie near enough to count as touched
};

template <int Dim>
struct Contact {
  using Vector = std::array<double, Dim>;
  std::vector<WallPoint<Dim>> walls;
  Absorbing<Dim> absorbing;
  std::vector<std::int32_t> node;       ///< per entry, into `nodes`
  std::vector<double> weight;           ///< per entry: the node's share of the wall point's impulse
  std::vector<std::int32_t> nodes;      ///< contact nodes as indices into Grid::nodes, ascending
  std::vector<std::uint64_t> in_block;  ///< per block: a bit for each of its contact nodes
  // Buffers of a step.
  std::vector<Vector> velocity;      ///< per contact node [m/s]
  std::vector<Vector> given;         ///< per contact node: by the walls in the last step [N s]
  std::vector<double> inverse_mass;  ///< per contact node [1/kg]
  std::vector<double> mobility;      ///< per wall point: sum of weight^2 / mass [1/kg]
  std::vector<Vector> impulse;     ///< per wall point, of the last step: the next one's guess [N s]
  std::vector<Vector> fresh;       ///< the same where there is no guess
  std::vector<std::int32_t> uses;  ///< per contact node: entries of active wall points
  std::vector<Vector> before;      ///< per dashpot: velocity of the soil before the step [m/s]
  std::vector<std::int32_t> active;   ///< wall points that soil touches
  std::vector<std::int32_t> coupled;  ///< those of them that share nodes with others
};

/// What wall points do to velocities that are not those of the momentum step.
enum class Hold {
  contact,  ///< push, with Coulomb friction
  slip,     ///< push, without friction
  fast,     ///< hold both ways, without friction, where the last step had an impulse
};

/// Places wall points where the ground and the walls cross the lines of the grid and links them to
/// the active blocks.
template <int Dim, class Basis>
void place_walls(const Grid<Dim>& grid, const Ground& ground, const Rollers& rollers,
                 Contact<Dim>& contact);

/// Finds velocities of the contact nodes that enter no wall point, from the velocities and masses
/// in `nodes`; they are left in contact.velocity.
template <int Dim>
void push_out(const StaggeredArray<Node>& nodes, Contact<Dim>& contact, double full_mass,
              Hold hold) noexcept;

/// Corrects the velocities after the momentum step; returns the work of all forces along the
/// corrections.
template <int Dim>
GridWork<Dim> hold_at_walls(Grid<Dim>& grid, Contact<Dim>& contact, const MomentumSettings& s,
                            double full_mass) noexcept;

}  // namespace flowslide::mpm
