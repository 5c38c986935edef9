#include "section/slip_search.hpp"

#include "core/check.hpp"
#include "core/elementary.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

namespace flowslide {
namespace {

constexpr double kNone = std::numeric_limits<double>::infinity();

using Variables = std::vector<double>;
using Objective = std::function<double(const Variables&)>;

/// Moves one variable at a time by its step while that helps, then halves the steps (Hooke and
/// Jeeves without the pattern move); `smallest` is the share of the first steps at which it ends.
double descend(const Objective& objective, Variables& at, Variables step, double smallest) {
  double best = objective(at);
  for (double share = 1.0; share > smallest;) {
    bool better = false;
    for (std::size_t i = 0; i < at.size(); ++i)
      for (const double sign : {1.0, -1.0}) {
        Variables trial = at;
        trial[i] += sign * share * step[i];
        const double value = objective(trial);
        if (!(value < best)) continue;
        best = value;
        at = trial;
        better = true;
      }
    if (!better) share *= 0.5;
  }
  return best;
}

double between(const std::array<double, 2>& range, int i, int n) {
  return n < 2 ? 0.5 * (range[0] + range[1]) : range[0] + (range[1] - range[0]) * i / (n - 1);
}

bool within(const std::array<double, 2>& range, double x) { return x >= range[0] && x <= range[1]; }

/// The arc from entry to exit whose middle lies `sag` chords below the chord; empty if it overhangs
/// or goes below the floor.
struct Arc {
  Vec2 centre{};
  double radius = 0.0;
  std::vector<Vec2> surface;
};
Arc arc_of(const SlopeModel& model, const SlipSearch& search, double entry, double exit,
           double sag) {
  const Vec2 a{entry, height_at(model.ground, entry)}, b{exit, height_at(model.ground, exit)};
  const double chord = hypot(b[0] - a[0], b[1] - a[1]);
  if (!(chord > 0.0) || !(sag > 0.0)) return {};
  const double depth = sag * chord;
  Arc arc_found;
  arc_found.radius = (0.25 * chord * chord + depth * depth) / (2.0 * depth);
  const double up = arc_found.radius - depth;
  arc_found.centre = {0.5 * (a[0] + b[0]) - up * (b[1] - a[1]) / chord,
                      0.5 * (a[1] + b[1]) + up * (b[0] - a[0]) / chord};
  if (arc_found.centre[1] < a[1] || arc_found.centre[1] - arc_found.radius < search.floor)
    return {};
  arc_found.surface = arc(arc_found.centre, arc_found.radius, a[0], b[0],
                          std::max(30, static_cast<int>((b[0] - a[0]) / search.slice_width)));
  return arc_found;
}

/// Slopes of the legs must rise from leg to leg: the surface is a trough without kinks downwards.
bool is_trough(const std::vector<Vec2>& surface) {
  constexpr double kSteepest = 3.0;  // about 72 degrees, near the active wedge of strong soil
  double before = -kSteepest;
  for (std::size_t i = 1; i < surface.size(); ++i) {
    const double dx = surface[i][0] - surface[i - 1][0];
    if (!(dx > 1e-3)) return false;
    const double slope = (surface[i][1] - surface[i - 1][1]) / dx;
    if (slope < before - 1e-9) return false;
    before = slope;
  }
  return before <= 1.0;
}

/// entry, exit, then x and y of the inner points.
std::vector<Vec2> surface_of(const SlopeModel& model, const Variables& v) {
  std::vector<Vec2> surface{{v[0], height_at(model.ground, v[0])}};
  for (std::size_t i = 2; i + 1 < v.size(); i += 2) surface.push_back({v[i], v[i + 1]});
  surface.push_back({v[1], height_at(model.ground, v[1])});
  return surface;
}

double factor_of(const SlopeModel& model, const SlipSearch& search, const Variables& v) {
  if (!within(search.entry, v[0]) || !within(search.exit, v[1])) return kNone;
  const std::vector<Vec2> surface = surface_of(model, v);
  for (const Vec2& p : surface)
    if (p[1] < search.floor) return kNone;
  if (!is_trough(surface)) return kNone;
  const auto result = spencer(cut_slices(model, surface, search.slice_width));
  return result ? result->factor : kNone;
}

/// Points of another surface at equal shares of its length in x.
Variables variables_of(const std::vector<Vec2>& surface, int points) {
  Variables v{surface.front()[0], surface.back()[0]};
  for (int i = 1; i + 1 < points; ++i) {
    const double x = v[0] + (v[1] - v[0]) * i / (points - 1);
    v.insert(v.end(), {x, height_at(surface, x)});
  }
  return v;
}

/// A surface of three legs with its two inner points, and more points put onto the level leg.
Variables three_legs(double entry, double exit, double from, double to, double level, int points) {
  Variables v{entry, exit};
  const int inner = points - 2;
  for (int i = 0; i < inner; ++i) {
    const double t = inner < 2 ? 0.5 : static_cast<double>(i) / (inner - 1);
    v.insert(v.end(), {from + t * (to - from), level});
  }
  return v;
}

struct Start {
  double factor = kNone;
  Variables variables;
};

std::vector<Start> starts_of_three_legs(const SlopeModel& model, const SlipSearch& search,
                                        std::vector<double> levels) {
  const double top = height_at(model.ground, search.entry[0]);
  for (int i = 1; i <= 5; ++i) levels.push_back(top - (top - search.floor) * i / 5.0);
  std::vector<Start> starts;
  for (const double level : levels)
    for (int e = 0; e < 5; ++e)
      for (int x = 0; x < 6; ++x) {
        const double entry = between(search.entry, e, 5), exit = between(search.exit, x, 6);
        const double fall = height_at(model.ground, entry) - level;
        const double rise = height_at(model.ground, exit) - level;
        if (!(exit > entry) || !(fall > 0.0)) continue;
        Start best;
        for (const double steep : {0.7, 1.4})
          for (const double flat : {0.3, 0.6}) {
            const double from = entry + fall / steep;
            const double to = exit - std::max(rise / flat, 0.5);
            if (!(to > from + 0.1)) continue;
            const Variables v = three_legs(entry, exit, from, to, level, search.points);
            const double factor = factor_of(model, search, v);
            if (factor < best.factor) best = {factor, v};
          }
        if (best.factor < kNone) starts.push_back(best);
      }
  return starts;
}

}  // namespace

CriticalCircle search_circles(const SlopeModel& model, const SlipSearch& search) {
  check(model);
  const Objective factor = [&](const Variables& v) {
    if (!within(search.entry, v[0]) || !within(search.exit, v[1]) || !(v[1] > v[0])) return kNone;
    const Arc a = arc_of(model, search, v[0], v[1], v[2]);
    if (a.surface.empty()) return kNone;
    return bishop(cut_slices(model, a.surface, search.slice_width)).value_or(kNone);
  };
  constexpr int kGrid = 10;
  std::vector<Start> starts;
  for (int e = 0; e < kGrid; ++e)
    for (int x = 0; x < kGrid; ++x)
      for (int s = 0; s < kGrid; ++s) {
        Variables v{between(search.entry, e, kGrid), between(search.exit, x, kGrid),
                    0.03 + 0.45 * s / (kGrid - 1)};
        const double f = factor(v);
        if (f < kNone) starts.push_back({f, std::move(v)});
      }
  if (starts.empty())
    throw NumericsError(
        "no admissible slip circle (every one leaves the soil or overhangs). Widen the ranges of "
        "entry and exit or lower the floor");
  std::stable_sort(starts.begin(), starts.end(),
                   [](const Start& a, const Start& b) { return a.factor < b.factor; });
  const Variables step{0.5 * (search.entry[1] - search.entry[0]) / kGrid,
                       0.5 * (search.exit[1] - search.exit[0]) / kGrid, 0.02};
  Start best;
  for (std::size_t i = 0; i < std::min<std::size_t>(3, starts.size()); ++i) {
    starts[i].factor = descend(factor, starts[i].variables, step, 1e-3);
    if (starts[i].factor < best.factor) best = starts[i];
  }
  const Arc a = arc_of(model, search, best.variables[0], best.variables[1], best.variables[2]);
  return {best.factor, a.centre, a.radius, a.surface};
}

CriticalSurface search_surfaces(const SlopeModel& model, const SlipSearch& search,
                                const std::vector<double>& levels) {
  check(model);
  validate(search.points >= 4, "slip surfaces of {} points (they need at least four)",
           search.points);
  std::vector<Start> starts = starts_of_three_legs(model, search, levels);
  const CriticalCircle circle = search_circles(model, search);
  const Variables round = variables_of(circle.surface, search.points);
  starts.push_back({factor_of(model, search, round), round});
  std::stable_sort(starts.begin(), starts.end(),
                   [](const Start& a, const Start& b) { return a.factor < b.factor; });
  Variables step{2.0, 2.0};
  for (int i = 2; i < search.points; ++i) step.insert(step.end(), {2.0, 1.0});
  const Objective factor = [&](const Variables& v) { return factor_of(model, search, v); };
  Start best;
  for (std::size_t i = 0; i < std::min<std::size_t>(4, starts.size()); ++i) {
    if (!(starts[i].factor < kNone)) continue;
    starts[i].factor = descend(factor, starts[i].variables, step, 0.02);
    if (starts[i].factor < best.factor) best = starts[i];
  }
  if (!(best.factor < kNone))
    throw NumericsError(
        "no admissible slip surface (force and moment balance on none of them). Widen the ranges "
        "of entry and exit or lower the floor");
  const std::vector<Vec2> surface = surface_of(model, best.variables);
  const auto result = spencer(cut_slices(model, surface, search.slice_width));
  return {result->factor, result->inclination, surface};
}

}  // namespace flowslide
