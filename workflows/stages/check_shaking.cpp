#include "workflows/stages/cross_checks.hpp"

#include <algorithm>
#include <cmath>

/// The ends of a shaken section, and what is recorded of it.
namespace flowslide {
namespace {

/// Highest and lowest ground at an end of the section [m].
Extent end_of(const QuadMesh& mesh, double x, double hair) {
  Extent e;
  for (const Vec2& p : mesh.nodes) {
    if (std::abs(p[0] - x) > hair) continue;
    e.bottom = std::min(e.bottom, p[1]);
    e.top = std::max(e.top, p[1]);
  }
  return e;
}

}  // namespace

void check_sides(const FemConfig& fem, const QuadMesh& mesh, Findings& found) {
  const FemSideConfig& sides = fem.sides;
  const Extent e = extent_of(mesh);
  const double hair = 1e-6 * (e.right - e.left);
  const double left = end_of(mesh, e.left, hair).height();
  const double right = end_of(mesh, e.right, hair).height();
  if (sides.kind == SideKind::fixed) {
    warn(
        found,
        "sides.kind: fixed ends of {:.3g} and {:.3g} m throw every wave back into the section, and "
        "hold soil that would move with the ground. Take free_field.",
        left, right);
    return;
  }
  // Ends that move as one must have as much soil behind them.
  constexpr double kAlike = 0.05;
  if (sides.kind == SideKind::tied && std::abs(left - right) > kAlike * std::max(left, right))
    warn(found,
         "sides.kind: tied ends move as one, but one is {:.3g} m high and the other {:.3g} m: what "
         "stands above is held by nothing. Take free_field.",
         left, right);
  constexpr double kThin = 100.0;
  if (sides.kind == SideKind::free_field && sides.thickness < kThin)
    warn(found,
         "sides.thickness: columns of {:g} m are so light beside a section of 1 m that it moves "
         "them: they do not shake as level ground. Take 1000 m.",
         sides.thickness);
}

void check_recording(const FemConfig& fem, const QuadMesh& mesh, std::optional<double> end,
                     std::optional<double> mean_period, Findings& found) {
  constexpr double kLeastStates = 2.0;  // in a period
  constexpr double kRare = 0.5;         // [s]
  constexpr double kLarge = 2e10;       // [bytes]
  constexpr double kBytesPerNode = 5 * sizeof(double), kBytesPerElement = 8 * sizeof(double);
  const double interval = fem.output_interval;
  if (interval > kRare)
    warn(found,
         "output_interval: {:g} s. The time of transfer and the largest r_u are looked for among "
         "recorded states only, and shaking has periods below 1 s. Take {:g} s or less.",
         interval, kRare);
  else if (mean_period && interval * kLeastStates > *mean_period)
    warn(found,
         "output_interval: {:g} s records {:.2g} states in a mean period of the motion, {:.2g} s: "
         "the largest r_u lies between them, and soil that liquefies may be missed. Take {:.1g} s.",
         interval, *mean_period / interval, *mean_period, 0.25 * *mean_period);
  if (!end) return;
  const double bytes = *end / interval *
                       (kBytesPerNode * static_cast<double>(mesh.num_nodes()) +
                        kBytesPerElement * static_cast<double>(mesh.num_elements()));
  if (bytes > kLarge)
    warn(found,
         "output_interval: {:g} s records {:.2g} states until {:g} s, up to {:.0f} GB. Is there "
         "room for them?",
         interval, *end / interval, *end, bytes / 1e9);
}

}  // namespace flowslide
