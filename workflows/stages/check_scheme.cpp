#include "core/check.hpp"
#include "core/conventions.hpp"
#include "workflows/stages/cross_checks.hpp"

#include <algorithm>
#include <cmath>

/// How a runout is computed, and when it ends.
namespace flowslide {
namespace {

void check_resistance(const FlowConfig& flow, Findings& found) {
  constexpr double kSteepest = 1.5;  // tan 56 deg
  constexpr double kSmoothest = 0.1;
  // Of the static dam in cells of 2.5 m, 73 m without: 65 m with 0.02, 61 m with 0.05.
  constexpr double kMostDamping = 0.01;
  const double friction = flow.ground.friction;
  if (friction > kSteepest)
    warn(found,
         "ground.friction: {:g} is more than ground has: it is a coefficient, the tangent of an "
         "angle.",
         friction);
  else if (friction < kSmoothest)
    warn(found, "ground.friction: {:g} is less than ground has: the soil slides as if on ice.",
         friction);
  if (flow.damping > kMostDamping)
    warn(found,
         "damping: {:g} of every force out of balance is held back, which no soil does: the runout "
         "is too short.",
         flow.damping);
  if (!(flow.gravity > 9.7 && flow.gravity < 9.9))
    warn(found, "gravity: {:g} m/s2 is not that of the earth.", flow.gravity);
}

/// Transfers of velocity that take motion from the soil in every step, so that the runout becomes
/// shorter with more steps (docs/theory/mpm.md).
void check_transfer(const FlowConfig& flow, Findings& found) {
  using mpm::Transfer;
  constexpr double kLeastShare = 0.9;
  // Of the static dam in cells of 2.5 m: 60 m with 0.03 s, 66 m with 0.1 s, 73 m with 0.3 s, 79 m
  // with 3 s, 84 m with 10 s.
  constexpr double kShort = 0.1, kLong = 3.0;
  constexpr const char* kLosing =
      "{} takes from the points in every step what the grid does not carry: the runout becomes "
      "shorter the more steps there are. Take aflip.";
  if (flow.transfer == Transfer::pic) warn(found, kLosing, "transfer: pic");
  if (flow.transfer == Transfer::fmpm) warn(found, kLosing, "transfer: fmpm");
  if (flow.transfer == Transfer::flip && flow.flip_share < kLeastShare)
    warn(found, kLosing, fmt::format("flip_share: {:g}", flow.flip_share));
  if (flow.transfer == Transfer::aflip && !(flow.relaxation >= kShort && flow.relaxation <= kLong))
    warn(found,
         "relaxation: {:g} s lies outside {:g} to {:g} s, where its influence on the runout has "
         "been measured: {}.",
         flow.relaxation, kShort, kLong,
         flow.relaxation < kShort ? "the soil moves as if in a viscous fluid, and stops early"
                                  : "motion that the grid does not see is not damped");
}

/// What replaces a point's velocity by that of the grid acts like a viscosity of the order of the
/// cell times the speed of waves, which stops a flow short (docs/theory/mpm.md).
void check_viscosity(const FlowConfig& flow, const Soil& soil, Findings& found) {
  using mpm::Transfer;
  constexpr double kEnoughCells = 32.0;
  if (flow.transfer != Transfer::apic && flow.transfer != Transfer::tpic) return;
  if (soil.counted.empty()) return;
  const double height = soil.counted.height(), cells = height / flow.cell;
  if (cells < kEnoughCells * (1.0 - 1e-6))
    warn(found,
         "transfer: {} holds a flow back like a viscosity that grows with the cell. With {:.2g} "
         "cells over {:g} m of soil the runout is too short; take aflip, or cells of {:.3g} m or "
         "less.",
         flow.transfer == Transfer::apic ? "apic" : "tpic", cells, height, height / kEnoughCells);
}

/// The slope of linear functions jumps where a point crosses into the next cell.
void check_basis(const FlowConfig& flow, Findings& found) {
  if (flow.basis == mpm::BasisKind::linear)
    warn(found,
         "basis: linear functions give soil that flows from cell to cell a jolt at each: the run "
         "may break off, or throw points about. Take quadratic or mls.");
}

void check_rest(const FlowConfig& flow, const Soil& soil, Findings& found) {
  constexpr double kMostShare = 0.01, kFastest = 0.2;  // [-], [m/s]
  const RestRule& rest = flow.rest;
  if (flow.end < rest.window)
    warn(found,
         "end: {:g} s is before rest.window has passed, {:g} s: the run cannot come to rest, and "
         "its runout is a lower bound.",
         flow.end, rest.window);
  if (flow.sample_interval > rest.window)
    warn(found,
         "sample_interval: {:g} s is longer than rest.window, {:g} s: rest is looked for in the "
         "rows of the time series, and the run may go on to its end.",
         flow.sample_interval, rest.window);
  const double fall = soil.all.empty() ? 0.0 : std::sqrt(soil.all.height() / kGravity);
  if (rest.window < fall)
    warn(
        found,
        "rest.window: in {:g} s soil {:g} m high has hardly begun to fall, which takes {:.2g} s: a "
        "run may be taken for at rest before it moves.",
        rest.window, soil.all.height(), fall);
  if (rest.kinetic_share > kMostShare)
    warn(found,
         "rest.kinetic_share: {:g} of its largest kinetic energy is left to a flow that counts as "
         "at rest.",
         rest.kinetic_share);
  if (rest.runout_change > kFastest * rest.window)
    warn(found,
         "rest.runout_change: a front that moves by {:g} m in {:g} s counts as at rest: the runout "
         "may be too short.",
         rest.runout_change, rest.window);
}

/// Soil that begins to move falls asleep if it has not come speed x after in the time `after`.
void check_sleep(const FlowConfig& flow, Findings& found) {
  if (!flow.sleep) return;
  constexpr double kWakes = 0.1;  // a hundredth of gravity [m/s2]
  const double held = 2.0 * flow.sleep->speed / flow.sleep->after;
  if (held > kWakes)
    warn(found,
         "sleep: soil that gathers speed with less than {:.2g} m/s2 is put to sleep (twice speed "
         "over after): what would have failed may stand. Take a smaller speed.",
         held);
}

}  // namespace

void check_scheme(const FlowConfig& flow, const Soil& soil, Findings& found) {
  check_resistance(flow, found);
  check_transfer(flow, found);
  check_viscosity(flow, soil, found);
  check_basis(flow, found);
  check_rest(flow, soil, found);
  check_sleep(flow, found);
  constexpr double kFarthest = 1e6;  // cells; the grid numbers its blocks with 20 bits
  if (soil.all.empty()) return;
  const double away = std::max(std::abs(flow.grid_origin[0] - soil.all.left),
                               std::abs(flow.grid_origin[1] - soil.all.bottom));
  if (!(away <= kFarthest * flow.cell))
    found.errors.push_back(fmt::format(
        "grid_origin: ({:g}, {:g}) m lies {:.3g} cells from the soil (farther than the grid can "
        "number) any node of the grid will do, such as one in the section",
        flow.grid_origin[0], flow.grid_origin[1], away / flow.cell));
}

}  // namespace flowslide
