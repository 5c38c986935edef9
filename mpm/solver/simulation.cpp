#include "mpm/solver/simulation.hpp"

#include "core/check.hpp"
#include "mpm/grid/local_grid.hpp"
#include "mpm/solver/way.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace flowslide::mpm {
namespace {

/// The affine field of debris: points that have opened so far that their neighbours, parted in one
/// direction, share no node with them. Nothing tells such a point that the soil around it thins, so
/// its rate of deformation would stay and its volume grow exponentially. As in free flight it falls
/// with time, D' = -D^2; the spin stays, and with it the angular momentum.
template <int Dim, class Basis>
void thin_debris(Simulation<Dim>& s, int threads) {
  const double since = s.time - s.binned;
  s.binned = s.time;
  if (!(since > 0.0)) return;
  Points<Dim>& p = s.points;
  const double reach = Basis::nodes * s.grid.h;
#pragma omp parallel for schedule(static) num_threads(threads)
  for (std::size_t q = 0; q < p.size(); ++q) {
    // V > reach L^(Dim-1), with L^Dim the point's volume without gaps.
    const double full = p.mass[q] / s.largest_density[p.material[q]];
    const double open = p.volume[q] / full, widest = reach * reach / full;
    if constexpr (Dim == 2) {
      if (!(open * open > widest)) continue;
    } else {
      if (!(open * open * open > widest * reach)) continue;
    }
    double trace = 0.0, square = 0.0;
    std::array<double, Dim * Dim> rate;
    for (int d = 0; d < Dim; ++d) {
      trace += p.c[(Dim + 1) * d][q];
      for (int e = 0; e < Dim; ++e) {
        rate[Dim * d + e] = 0.5 * (p.c[Dim * d + e][q] + p.c[Dim * e + d][q]);
        square += rate[Dim * d + e] * rate[Dim * d + e];
      }
    }
    if (!(trace > 0.0)) continue;
    const double lost = 1.0 - 1.0 / (1.0 + since * std::sqrt(square));
    for (int i = 0; i < Dim * Dim; ++i) p.c[i][q] -= lost * rate[i];
  }
}

/// What a tile costs beside its points, in points.
constexpr double kTileWeight = 30.0;

/// Every thread may meet the largest tile.
template <int Dim>
void size_tile_scratch(const Simulation<Dim>& s, StepScratch<Dim>& scratch) {
  std::size_t most = 0;
  for (const Tile<Dim>& t : s.tiling.tiles) most = std::max<std::size_t>(most, t.last - t.first);
  most += Pack::lanes;
  for (auto& t : scratch.tile) {
    for (auto& g : t.gradient) g.resize(most);
    for (auto& v : t.velocity) v.resize(most);
    t.average.change.resize(most);
    t.average.value.resize(most);
    t.average.sum.resize(kSpans<Dim>);
    t.average.mean.resize(kSpans<Dim>);
  }
}

template <int Dim>
void deal_tiles(const Simulation<Dim>& s, StepScratch<Dim>& scratch) {
  for (Group& group : scratch.groups)
    deal(group, [&](std::int32_t t) {
      return double(s.tiling.tiles[t].last - s.tiling.tiles[t].first) + kTileWeight;
    });
  deal(scratch.asleep, [](std::int32_t) { return 1.0; });
}

/// Tiles whose window holds no contact node need not wait for the walls.
template <int Dim, class Basis>
void group_tiles(const Simulation<Dim>& s, StepScratch<Dim>& scratch) {
  std::vector<bool> held(s.grid.nodes.size(), false);
  for (const std::int32_t node : s.contact.nodes) held[node] = true;
  for (Group& group : scratch.groups) group.tiles.clear();
  scratch.asleep.tiles.clear();
  for (std::size_t t = 0; t < s.tiling.tiles.size(); ++t) {
    if (s.sleep.sleeps(s.points, s.tiling.tiles[t])) {
      scratch.asleep.tiles.push_back(static_cast<std::int32_t>(t));
      continue;
    }
    bool touches = false;
    for_each_row<Dim, kLocalWidth<Dim, Basis>>(
        s.tiling.tiles[t], [&](int, std::int32_t block, int node, int count) {
          for (int i = 0; i < count; ++i)
            touches = touches || held[std::size_t(block) * kBlockNodes<Dim> + node + i];
        });
    scratch.groups[touches ? 1 : 0].tiles.push_back(static_cast<std::int32_t>(t));
  }
  deal_tiles(s, scratch);
}

/// Lets tiles fall asleep and wakes others. A wave may be faster in what wakes.
template <int Dim>
void sleep_or_wake(Simulation<Dim>& s) {
  std::vector<std::int32_t> restless;
  for (const Load<Dim>& load : s.loads) restless.push_back(load.index);
  const SleepChange<Dim> change =
      look_for_sleep(s.time, restless, s.grid, s.tiling, s.points, s.sleep);
  for (int d = 0; d < Dim; ++d) s.balance.grid.boundary_impulse[d] += change.impulse[d];
  if (!change.woken) return;
  const Points<Dim>& p = s.points;
  for (std::size_t q = 0; q < p.size(); ++q) {
    const double modulus = s.materials[p.material[q]].wave_modulus;
    s.last.max_wave2 = std::max(s.last.max_wave2, modulus * p.volume[q] / p.mass[q]);
  }
}

/// The step by s.dt or, where that takes points too far, a shorter one.
template <int Dim>
void take_step(Simulation<Dim>& s, StepScratch<Dim>& scratch) {
  constexpr double kShortest = 1e-9;
  const double whole = s.dt;
  const auto go = [&] {
    return visit_basis(s.settings.basis,
                       [&]<class Basis>(Basis) { return step<Dim, Basis>(s, scratch); });
  };
  // With usf stress has changed already.
  const bool once = s.settings.update == Update::usf;
  for (double share = go(); share != 1.0; share = go()) {
    if (std::isnan(share))
      throw NumericsError(fmt::format(
          "step {}, t = {:.4g} s: velocities are no longer finite (the state has become "
          "unphysical) check gravity, tractions, stresses at the start, and strengths and stiffness "
          "of the materials, or try a smaller courant",
          s.step, s.time));
    s.dt *= share;
    if (!once && s.dt > kShortest * whole) continue;
    throw NumericsError(fmt::format(
        "step {}, t = {:.4g} s: the forces are so large that points would move by more than a cell "
        "in a step of {:.3g} s{} (the soil is accelerated beyond anything that can be followed) "
        "check gravity, tractions, stresses at the start and the units of stiffness and density{}",
        s.step, s.time, whole, once ? "" : ", and in any shorter one",
        once ? ", or take update symplectic, which can shorten its step" : ""));
  }
}

/// Throws if the last step took a point so far, or strained it so, that the result makes no sense.
template <int Dim>
void check_way(const Simulation<Dim>& s) {
  const double way = std::sqrt(s.last.max_speed2) * s.dt / s.grid.h;
  const bool far = !(way <= kFarthestWay), strained = !(s.last.max_strain <= kLargestStrain);
  if (!far && !strained) return;
  const Points<Dim>& p = s.points;
  std::size_t fastest = 0;
  double most2 = -1.0;
  for (std::size_t q = 0; q < p.size(); ++q) {
    double speed2 = 0.0, rate2 = 0.0;
    for (const auto& v : p.v) speed2 += v[q] * v[q];
    for (const auto& c : p.c) rate2 += c[q] * c[q];
    const double size2 = far ? speed2 : rate2;
    if (!(size2 <= most2)) fastest = q, most2 = size2;
    if (std::isnan(size2)) break;
  }
  throw NumericsError(fmt::format(
      "step {}, t = {:.4g} s: particle {} (counted from 0 in order of id) at ({:.2f}, {:.2f}) "
      "{} in one step, with {:.3g} m/s (the grid cannot follow that) check gravity, tractions, "
      "stiffness and strength of the materials, or try a smaller courant and velocity_limit",
      s.step, s.time, p.index[fastest], p.x[0][fastest], p.x[Dim - 1][fastest],
      far ? fmt::format("moved by {:.2g} cells", way)
          : fmt::format("was strained by {:.2g}", s.last.max_strain),
      std::sqrt(s.last.max_speed2)));
}

}  // namespace

template <int Dim>
double stable_step(const Simulation<Dim>& s) {
  const double h = s.grid.h;
  const double elastic =
      stable_cells<Dim>(s.settings) * h / std::sqrt(s.last.max_wave2) * s.settings.courant;
  const double speed = std::sqrt(s.last.max_speed2);
  const double advective = s.settings.velocity_limit * h / std::max(speed, 1e-300);
  // The rate of the last step stands for this one.
  const double straining =
      s.dt > 0.0 ? s.settings.strain_limit * s.dt / std::max(s.last.max_strain, 1e-300) : elastic;
  return std::min({elastic, advective, straining});
}

template <int Dim>
void prepare(Simulation<Dim>& s, StepScratch<Dim>& scratch, bool rebin) {
  if (rebin) {
    let_out(s.outlet, s.points, s.gone);
    const double shift = visit_basis(s.settings.basis, [&]<class Basis>(Basis) {
      thin_debris<Dim, Basis>(s, static_cast<int>(scratch.tile.size()));
      return Basis::shift;
    });
    if constexpr (Dim == 3)
      if (s.ground.field) check_covered(*s.ground.field, s.points.x[0], s.points.x[1], s.time);
    bin_points<Dim>(s.points, s.grid, s.tiling, shift, scratch.binning);
    if (s.sleep.on()) sleep_or_wake(s);
    s.drift = 0.0;
  } else {
    link_tiles<Dim>(s.grid, s.tiling);
  }
  visit_basis(s.settings.basis, [&]<class Basis>(Basis) {
    if (rebin) measure_dashpots<Dim, Basis>(s.grid, s.points, s.materials, s.contact.absorbing);
    // Walls hang on the active blocks, dashpots on the soil at the planes too.
    if (!s.contact.absorbing.dashpots.empty() || scratch.walled != s.grid.blocks) {
      place_walls<Dim, Basis>(s.grid, s.ground, s.rollers, s.contact);
      scratch.walled = s.grid.blocks;
    }
    scratch.windows.resize(s.tiling.tiles.size() * kWindowNodes<Dim, Basis>);
  });
  find_points(s.loads, s.points, s.tiling);
  scratch.span.resize(s.points.size());
  scratch.scattered = false;
  visit_basis(s.settings.basis, [&]<class Basis>(Basis) { group_tiles<Dim, Basis>(s, scratch); });
  visit_basis(s.settings.basis, [&]<class Basis>(Basis) {
    const auto lightest = std::min_element(s.points.mass.begin(), s.points.mass.end());
    if (lightest != s.points.mass.end()) scratch.light = *lightest / power<Dim>(Basis::nodes);
  });
  if (rebin) s.contact.impulse.assign(s.contact.walls.size(), {});
  size_tile_scratch(s, scratch);
  scratch.stress_work.resize(s.tiling.tiles.size());
  scratch.sleep_work.resize(scratch.asleep.tiles.empty() ? 0 : s.tiling.tiles.size());
  scratch.grid_work.resize(s.grid.blocks.size());
  scratch.gain2.resize(s.grid.blocks.size());
  const bool fmpm = s.settings.transfer == Transfer::fmpm;
  if (fmpm || s.settings.update != Update::symplectic) scratch.second.resize(s.grid.nodes.size());
  if (fmpm) scratch.third.resize(s.grid.nodes.size());
  if (s.settings.update == Update::musl)
    for (auto& x : scratch.moved) x.resize(s.points.size());
}

template <int Dim>
void use_threads(const Simulation<Dim>& s, StepScratch<Dim>& scratch, int threads) {
  scratch.resize(threads);
  size_tile_scratch(s, scratch);
  deal_tiles(s, scratch);
}

template <int Dim>
void advance(Simulation<Dim>& s, StepScratch<Dim>& scratch) {
  if (s.drift > 0.95 * s.grid.h || (s.sleep.on() && s.time >= s.sleep.next_look))
    prepare(s, scratch, true);
  s.dt = stable_step(s);
  take_step(s, scratch);

  // Serial sums in a fixed order: the same bits for any number of threads.
  StressWork stress;
  for (const StressWork& w : scratch.stress_work) stress.add(w);
  GridWork<Dim> grid;
  for (const GridWork<Dim>& w : scratch.grid_work) grid.add(w);
  grid.add(scratch.contact_work);
  for (const std::int32_t t : scratch.asleep.tiles) grid.add(scratch.sleep_work[t]);
  if (s.settings.update == Update::usf) {
    // The force is that of the stress after the update, the strain that of the velocity before.
    std::swap(stress.power_start, stress.power_end);
    std::swap(grid.internal_start, grid.internal_end);
  }
  s.balance.grid.add(grid);
  s.balance.power_start += stress.power_start;
  s.balance.power_end += stress.power_end;
  // Of soil that sleeps there are no waves; its step is that of when it fell asleep.
  if (!(stress.max_wave2 > 0.0)) stress.max_wave2 = s.last.max_wave2;
  s.last = stress;
  s.drift += std::sqrt(stress.max_speed2) * s.dt;
  for (const TileScratch<Dim>& t : scratch.tile)
    if (t.outside) s.drift = std::numeric_limits<double>::infinity();
  s.time += s.dt;
  ++s.step;
  check_way(s);
}

template double stable_step<2>(const Simulation<2>&);
template double stable_step<3>(const Simulation<3>&);
template void prepare<2>(Simulation<2>&, StepScratch<2>&, bool);
template void prepare<3>(Simulation<3>&, StepScratch<3>&, bool);
template void use_threads<2>(const Simulation<2>&, StepScratch<2>&, int);
template void use_threads<3>(const Simulation<3>&, StepScratch<3>&, int);
template void advance<2>(Simulation<2>&, StepScratch<2>&);
template void advance<3>(Simulation<3>&, StepScratch<3>&);

}  // namespace flowslide::mpm
