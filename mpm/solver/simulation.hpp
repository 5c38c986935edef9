#pragma once
#include "mpm/grid/binning.hpp"
#include "mpm/grid/shares.hpp"
#include "mpm/kernels/momentum.hpp"
#include "mpm/kernels/stress.hpp"
#include "mpm/solver/outlet.hpp"
#include "mpm/solver/sleep.hpp"
#include "mpm/solver/traction.hpp"
#include "mpm/walls/contact.hpp"

#include <cstdint>
#include <vector>

/// The state of a run and one time step.
namespace flowslide::mpm {

/// Sums since the start; with the points' own energies they close the balances.
template <int Dim>
struct Balance {
  GridWork<Dim> grid;
  double power_start = 0.0;  ///< sum of StressWork::power_start [J]
  double power_end = 0.0;    ///< sum of StressWork::power_end [J]
};

template <int Dim>
struct Simulation {
  Points<Dim> points;
  Points<Dim> gone;  ///< those that left through the outlet, as they left, in order of leaving
  std::vector<SolverMaterial> materials;
  Grid<Dim> grid;
  Tiling<Dim> tiling;
  Ground ground;
  Rollers rollers;
  Outlet<Dim> outlet;
  std::vector<Load<Dim>> loads;  ///< in order of their points' index
  Contact<Dim> contact;
  Sleep<Dim> sleep;
  StepSettings settings;
  std::array<double, 3> gravity{};  ///< [m/s2]
  double full_mass = 0.0;           ///< mass of a full cell [kg], the scale of the mass floor
  /// Per material, of its points at the start [kg/m3]; 0: its points never count as debris.
  std::vector<double> largest_density;

  double time = 0.0;  ///< [s]
  double dt = 0.0;    ///< last step [s]
  std::int64_t step = 0;
  double drift = 0.0;   ///< bound of what any point moved since the points were binned [m]
  double binned = 0.0;  ///< when that was [s]
  StressWork last;      ///< of the last step; decides the next dt
  Balance<Dim> balance;

  [[nodiscard]] bool averages(std::int32_t material) const {
    return settings.volume_average == VolumeAverage::automatic &&
           materials[material].average_volume;
  }
};

/// How far a step takes points.
struct Way {
  double length = 0.0;  ///< of the point that goes farthest [cells]
  double strain = 0.0;  ///< largest |L| dt [-]
};

/// Buffers of a step, one set per thread where threads write.
template <int Dim>
struct StepScratch {
  BinningScratch binning;
  std::array<Group, 2> groups;          ///< tiles apart from walls, tiles that touch a contact node
  Group asleep;                         ///< tiles in neither of them
  StaggeredArray<Node> windows;         ///< per tile what its points give to their nodes
  std::vector<std::int32_t> span;       ///< per point, where it was when it was scattered
  bool scattered = false;               ///< windows hold the present points; false after changes
  std::vector<TileScratch<Dim>> tile;   ///< per thread
  double light = 0.0;                   ///< MomentumSettings::light
  std::vector<StressWork> stress_work;  ///< per tile
  std::vector<double> gain2;            ///< per block, of update_momentum [m2/s2]
  double gain2_at_walls = 0.0;          ///< the largest at contact nodes; way.hpp
  std::vector<Coordinate<Dim>> walled;  ///< active blocks that the walls were placed for
  std::vector<Way> ways;                ///< per tile, where the step had to be looked at
  std::vector<GridWork<Dim>> grid_work;   ///< per block
  std::vector<GridWork<Dim>> sleep_work;  ///< per tile, of those asleep
  GridWork<Dim> contact_work;
  StaggeredArray<Node> second, third;  ///< as grid.nodes, where update or transfer need them
  std::array<StaggeredArray<double>, Dim> moved;  ///< new positions of musl [m]
  explicit StepScratch(int threads) { resize(threads); }
  /// For so many threads; the groups have to be dealt anew.
  void resize(int threads) {
    tile.resize(threads);
    for (Group& group : groups) group.shares.resize(threads);
    asleep.shares.resize(threads);
    binning.copy.resize(threads);
  }
};

/// Time step by the point bound of docs/theory/time-step.md, the velocity and the strain limit [s].
template <int Dim>
double stable_step(const Simulation<Dim>& s);

/// Brings tiles and boundary lists up to date with the points, lets those beyond the outlet go, and
/// sizes the scratch. Also called after a checkpoint was read, then with tiles as they were
/// (`rebin` false).
template <int Dim>
void prepare(Simulation<Dim>& s, StepScratch<Dim>& scratch, bool rebin);

/// From the next step on; what the points gave to the grid for it stays. Results do not depend on
/// the number.
template <int Dim>
void use_threads(const Simulation<Dim>& s, StepScratch<Dim>& scratch, int threads);

/// One step; nothing in it allocates, throws or depends on the number of threads, unless the points
/// are binned anew or accelerate so hard that it has to be shortened. A sweep over the tiles leaves
/// what the points give to the grid for the next step; who changes points between steps sets
/// scratch.scattered to false. Throws NumericsError where a point would move too far, names it, and
/// leaves the state useless.
template <int Dim>
void advance(Simulation<Dim>& s, StepScratch<Dim>& scratch);

/// What advance does between choosing dt and summing up, for one basis; one file per basis. Returns
/// 1 when it is done; else by how much dt has to shrink for the points not to move too far, the
/// step not taken. Not a number: none would do.
template <int Dim, class Basis>
double step(Simulation<Dim>& s, StepScratch<Dim>& scratch);

}  // namespace flowslide::mpm
