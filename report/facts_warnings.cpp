#include "model/front.hpp"
#include "report/facts.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace flowslide {
namespace {

void warn_about_balances(ReportFacts& f, const ReportConfig& c) {
  const auto warn = [&](const char* what, double value, double limit) {
    if (!(std::abs(value) <= limit))
      f.warnings.push_back(fmt::format(
          "The {} balance is off by {:.2g} (limit {:.2g}). Do not use the runout before the cause "
          "is known.",
          what, value, limit));
  };
  warn("mass", f.mass_error, c.mass_warning);
  warn("energy", f.energy_error, c.energy_warning);
  warn("momentum", f.momentum_error, c.momentum_warning);
}

/// A run whose front rests has its runout, though soil behind may still move.
void warn_about_rest(ReportFacts& f, const RestRule& rest) {
  if (is_set(f.front_at_rest)) return;
  if (!is_set(f.time_at_rest))
    f.warnings.push_back(fmt::format(
        "The run was stopped before rest: after {:.4g} s the kinetic energy was still above {:.2g} "
        "of its peak and the front was still moving. The final runout is larger; raise `end` of "
        "the flow stage.",
        f.duration, rest.kinetic_share));
  else if (f.front_change > rest.runout_change)
    f.warnings.push_back(fmt::format(
        "The run was stopped before rest: the kinetic energy stays below {:.2g} of its peak from "
        "{:.4g} s on, but the front still moved by {:.2g} m in the last {:g} s. The final runout "
        "is larger; raise `end` of the flow stage.",
        rest.kinetic_share, f.time_at_rest, f.front_change, rest.window));
}

void warn_about_outlet(ReportFacts& f, const ParticleSet& p) {
  if (!(f.points_left > 0.0)) return;
  double mass = 0.0;
  for (const double m : p.mass) mass += m;
  f.warnings.push_back(fmt::format(
      "{:.0f} points, {:.2g} % of the mass, left the model through its outlet. They count where "
      "they left: the runout is a lower bound if they left downstream.",
      f.points_left, 100.0 * f.mass_left / mass));
}

void warn_about_upstream_end(ReportFacts& f, const ParticleSet& p, const FinalState& end) {
  constexpr double margin = 5.0;  // point spacings
  double left = std::numeric_limits<double>::infinity();
  double left_failed = left;
  double spacing = 0.0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    left = std::min(left, p.position[i][0]);
    spacing = std::max(spacing, std::sqrt(p.volume[i]));
    if (end.failed[i]) left_failed = std::min(left_failed, p.position[i][0]);
  }
  if (left_failed < left + margin * spacing)
    f.warnings.push_back(fmt::format(
        "The failure reaches the upstream end of the model (x = {:.1f} m), which may have limited "
        "the released volume. Transfer a longer section.",
        left));
}

/// x of the kFrontRank-th point from the left, of those that count.
double left_front(const std::vector<std::array<double, 3>>& at, const FinalState& end) {
  std::vector<double> x;
  for (std::size_t i = 0; i < at.size(); ++i)
    if (end.counts[i]) x.push_back(at[i][0]);
  if (x.empty()) return kUnset;
  const auto front = x.begin() + std::min(std::ssize(x), std::ptrdiff_t{kFrontRank}) - 1;
  std::nth_element(x.begin(), front, x.end());
  return *front;
}

/// A section with two slopes may fail to the side on which no runout is counted.
void warn_about_other_side(ReportFacts& f, const ParticleSet& p, const FinalState& end,
                           const ReportConfig& config) {
  constexpr double share_told = 0.1;
  constexpr double cell = 2.0;  // spacings of points, as points_per_cell has them
  double moved = 0.0, left = 0.0, volume = 0.0;
  std::size_t counted = 0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    if (!end.counts[i]) continue;
    volume += p.volume[i];
    ++counted;
    if (!end.failed[i]) continue;
    moved += p.mass[i];
    if (end.position[i][0] < end.undeformed[i][0] - config.moved) left += p.mass[i];
  }
  if (counted == 0) return;
  const double from = left_front(end.undeformed, end), to = left_front(end.position, end);
  const double told = std::max(1.0, cell * std::sqrt(volume / static_cast<double>(counted)));
  const bool passes = from - to > told;
  if (!passes && !(left > share_told * moved)) return;
  const std::string way =
      passes ? fmt::format("its front there passed {:.1f} m, from x = {:.1f} m to {:.1f} m",
                           from - to, from, to)
             : "it stayed within the section there";
  f.warnings.push_back(fmt::format(
      "Soil went to the left as well: {}, and {:.0f} % of the mass that moved by more than {:g} m "
      "moved that way. The runout counts to the right only: mirror the section to have that of the "
      "left.",
      way, moved > 0.0 ? 100.0 * left / moved : 0.0, config.moved));
}

}  // namespace

void warn_without_failure(ReportFacts& f, const LiquefactionZone& zone,
                          const ReportConfig& config) {
  if (!zone.no_failure_found() || !(f.outcome.largest.flow > config.moved)) return;
  const CrestFacts& crest = f.outcome.crest;
  const std::string moved =
      is_set(crest.level)
          ? fmt::format("; its crest moved {:.2f} m outward and settled {:.2f} m until then",
                        crest.outward.shaking, crest.settlement.shaking)
          : "";
  f.warnings.push_back(fmt::format(
      "No failure was found in the shaking, which ends at t = {:.4g} s{}. What flows does so by the "
      "residual strengths alone, which the soil is given at the transfer.",
      zone.transfer_time, moved));
}

void add_warnings(ReportFacts& f, const ParticleSet& p, const FinalState& end,
                  const std::vector<MpmSample>& samples, const RestRule& rest,
                  const ReportConfig& config) {
  warn_about_rest(f, rest);
  warn_about_balances(f, config);
  warn_about_outlet(f, p);
  const MpmSample& last = samples.back();
  if (!(std::abs(last.front - f.front) <= rest.runout_change))
    f.warnings.push_back(fmt::format(
        "The last frame (t = {:.4g} s) puts the front at x = {:.2f} m, the time series (t = {:.4g} "
        "s) at x = {:.2f} m. This report uses the frame.",
        end.time, f.front, last.time, last.front));
  if (f.runout > 0.0 && f.runout - f.runout_mass > 0.1 * f.runout)
    f.warnings.push_back(fmt::format(
        "A thin or detached tip leads the flow: the runout is {:.1f} m by the fifth-farthest point "
        "but {:.1f} m if {:.2g} % of the failed mass is left out.",
        f.runout, f.runout_mass, 100.0 * config.mass_quantile));
  if (!is_set(f.toe))
    f.warnings.emplace_back(
        "No soil that counts has a downstream end, so the report has no runout. Give `toe`.");
  warn_about_upstream_end(f, p, end);
  warn_about_other_side(f, p, end, config);
}

}  // namespace flowslide
