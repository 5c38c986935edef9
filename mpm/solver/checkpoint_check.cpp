#include "mpm/solver/checkpoint_check.hpp"

#include "core/check.hpp"

#include <algorithm>
#include <cmath>
#include <type_traits>

namespace flowslide::mpm {
namespace {

constexpr double kLargestDrift = 0.95;  ///< [cells]; advance() bins points anew beyond it
constexpr std::int32_t kFarthestBlock = (1 << 19) - 2;  ///< as bin_points numbers them

/// Without the magnitude, which the lowest of all numbers has not.
bool within(std::int32_t x, std::int32_t farthest) { return x >= -farthest && x <= farthest; }

bool finite(const auto&... x) { return (std::isfinite(x) && ...); }

template <int Dim>
bool plausible_times(const Simulation<Dim>& s, const RunState& run) {
  return finite(s.time, s.dt, s.drift, s.binned, s.last.max_wave2, s.last.max_speed2,
                s.last.max_strain, run.next_frame, run.next_sample, run.first_dt, run.peak_kinetic,
                s.sleep.next_look) &&
         s.time >= 0.0 && s.dt > 0.0 && s.step > 0 && s.drift >= 0.0 && s.last.max_wave2 > 0.0 &&
         s.last.max_speed2 >= 0.0 && s.last.max_strain >= 0.0 && run.first_dt > 0.0 &&
         run.frames > 0 && run.next_frame > 0.0 && run.next_sample > s.time && run.updates >= 0;
}

template <int Dim>
bool same_lengths(const Points<Dim>& points) {
  bool same = true;
  visit_arrays(points, [&](const auto& array) { same = same && array.size() == points.size(); });
  return same;
}

/// Every point is there once, with numbers that a step can start from.
template <int Dim>
bool sound_points(const Simulation<Dim>& s, std::size_t points) {
  std::vector<bool> seen(points, false);
  for (const Points<Dim>* p : {&s.points, &s.gone}) {
    bool sound = true;
    visit_arrays(*p, [&](const auto& array) {
      if constexpr (std::is_floating_point_v<std::decay_t<decltype(array[0])>>)
        for (const double x : array) sound = sound && std::isfinite(x);
    });
    for (std::size_t q = 0; q < p->size(); ++q) {
      const std::int32_t i = p->index[q], m = p->material[q];
      if (i < 0 || std::size_t(i) >= points || seen[i]) return false;
      if (m < 0 || m >= std::ssize(s.materials)) return false;
      if (!(p->mass[q] > 0.0 && p->volume[q] > 0.0)) return false;
      seen[i] = true;
    }
    if (!sound) return false;
  }
  return true;
}

template <int Dim>
bool sound_tiles(const Simulation<Dim>& s) {
  const auto& [tiles, run_first, runs, reach_first, reach] = s.tiling;
  if (run_first.size() != tiles.size() + 1 || run_first.front() != 0 ||
      run_first.back() != std::ssize(runs))
    return false;
  std::int32_t at = 0;
  for (std::size_t t = 0; t < tiles.size(); ++t) {
    const Tile<Dim>& tile = tiles[t];
    for (const std::int32_t c : tile.block)
      if (!within(c, kFarthestBlock)) return false;
    if (tile.first != at || tile.last <= at || tile.last > std::ssize(s.points.mass)) return false;
    if (run_first[t + 1] < run_first[t] || run_first[t + 1] > std::ssize(runs)) return false;
    for (std::int32_t r = run_first[t]; r < run_first[t + 1]; ++r) {
      if (runs[r].first != at || runs[r].last <= at || runs[r].last > tile.last) return false;
      for (; at < runs[r].last; ++at)
        if (s.points.material[at] != runs[r].material) return false;
    }
    if (at != tile.last) return false;
  }
  return at == std::ssize(s.points.mass);
}

/// Points lie where the window of their tile reaches, unless they are to be binned anew anyway.
template <int Dim>
bool within_windows(const Simulation<Dim>& s) {
  if (s.drift > kLargestDrift * s.grid.h) return true;
  constexpr int B = kBlockWidth<Dim>;
  const double shift =
      visit_basis(s.settings.basis, []<class Basis>(Basis) { return Basis::shift; });
  for (const Tile<Dim>& tile : s.tiling.tiles)
    for (std::int32_t q = tile.first; q < tile.last; ++q)
      for (int d = 0; d < Dim; ++d) {
        const double cells = (s.points.x[d][q] - s.grid.origin[d]) / s.grid.h;
        const double base = std::floor(cells - shift) - B * tile.block[d];
        if (!(base >= -1.0 && base <= B)) return false;
      }
  return true;
}

template <int Dim>
bool sound_sleep(const Sleep<Dim>& sleep, std::size_t points) {
  const std::size_t n = sleep.on() ? points : 0;
  bool sound = sleep.since.size() == n && sleep.asleep.size() == n && sleep.count >= 0 &&
               sleep.count <= static_cast<std::int64_t>(n);
  for (const auto& x : sleep.place) sound = sound && x.size() == n;
  return sound;
}

template <int Dim>
bool sound_dashpots(const Absorbing<Dim>& absorbing) {
  return std::all_of(absorbing.dashpots.begin(), absorbing.dashpots.end(), [&](const auto& d) {
    bool sound = d.plane >= 0 && d.plane < 2 * Dim && std::isfinite(absorbing.plane(d.plane)) &&
                 finite(d.area, d.area_start, d.normal, d.shear);
    for (const std::int32_t node : d.line)
      sound = sound && within(node, kBlockWidth<Dim> * kFarthestBlock);
    for (const double force : d.support) sound = sound && std::isfinite(force);
    return sound;
  });
}

}  // namespace

template <int Dim>
std::string find_misfit(const Simulation<Dim>& s, const RunState& run, std::size_t points) {
  if (s.points.size() + s.gone.size() != points)
    return fmt::format("it has another number of points: {} instead of {}",
                       s.points.size() + s.gone.size(), points);
  if (!same_lengths(s.points) || !same_lengths(s.gone)) return "its arrays differ in length";
  if (!plausible_times(s, run)) return "its times, steps or counts cannot be those of a run";
  if (!sound_points(s, points)) return "a point in it cannot be one of this run";
  if (!sound_tiles(s)) return "its tiles do not hold its points";
  if (!within_windows(s)) return "a point in it lies outside its tile";
  if (!sound_sleep(s.sleep, points)) return "its sleeping points do not belong to this run";
  if (!sound_dashpots(s.contact.absorbing)) return "its absorbing planes are not those of this run";
  return "";
}

template std::string find_misfit<2>(const Simulation<2>&, const RunState&, std::size_t);
template std::string find_misfit<3>(const Simulation<3>&, const RunState&, std::size_t);

}  // namespace flowslide::mpm
