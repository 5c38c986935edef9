#include "report/markdown_outcome.hpp"

#include "report/audit_table.hpp"

#include <algorithm>
#include <cmath>

namespace flowslide {
namespace {

/// The first sentence: the word for what happened, with the number that stands behind it.
std::string headline(const ReportFacts& f, const ReportConfig& c) {
  const OutcomeFacts& o = f.outcome;
  if (o.outcome == Outcome::stood)
    return fmt::format(
        "**The section stood.** Less than 0.5 % of its mass moved by more than {:g} m. ", c.stood);
  if (o.outcome == Outcome::deformed)
    return fmt::format(
        "**The section deformed and held:** all but 0.5 % of its mass moved by less than {:.2f} "
        "m. ",
        o.largest.both);
  const std::string what = fmt::format("The section {}", word(o.outcome));
  if (f.runout > 0.0)
    return fmt::format("**{}, passed the toe and ran out {:.1f} m** (front at x = {:.1f} m). ",
                       what, f.runout, f.front);
  if (!is_set(f.toe))
    return fmt::format("**{}; without a toe there is no runout** (front at x = {:.1f} m). ", what,
                       f.front);
  return fmt::format(
      "**{} but its front did not pass the toe: the runout is 0 m** (front at x = {:.1f} m, {:.1f} "
      "m short of the toe). ",
      what, f.front, f.toe - f.front);
}

std::string crest_sentence(const CrestFacts& crest) {
  if (!is_set(crest.level)) return "";
  std::string out = fmt::format("Its crest moved {:.2f} m outward and settled {:.2f} m",
                                crest.outward.both, crest.settlement.both);
  if (std::max(std::abs(crest.outward.shaking), std::abs(crest.settlement.shaking)) >= 0.005)
    out += fmt::format(", of which {:.2f} and {:.2f} m up to the transfer", crest.outward.shaking,
                       crest.settlement.shaking);
  if (is_set(crest.freeboard))
    out += crest.freeboard > 0.0
               ? fmt::format("; {:.2f} m of freeboard are left", crest.freeboard)
               : fmt::format("; **the crest lies {:.2f} m below the pond**", -crest.freeboard);
  return out + ". ";
}

/// How the run ended: by which of the two rules of rest, and what still moves then.
std::string rest_sentence(const ReportFacts& f) {
  constexpr double told = 0.05;  // [m/s] of the fastest point
  const std::string front = fmt::format("within {:g} m since", f.rest.runout_change),
                    energy = fmt::format("below {:g} of its peak since", f.rest.kinetic_share);
  std::string out;
  if (is_set(f.front_at_rest) && is_set(f.time_at_rest))
    out = fmt::format(
        "The front came to rest {:.1f} s after the transfer ({}), the kinetic energy after {:.1f} "
        "s ({}).",
        f.front_at_rest, front, f.time_at_rest, energy);
  else if (is_set(f.front_at_rest))
    out = fmt::format(
        "The front came to rest {:.1f} s after the transfer ({}); the kinetic energy was still "
        "above {:g} of its peak when the run ended.",
        f.front_at_rest, front, f.rest.kinetic_share);
  else if (is_set(f.time_at_rest))
    out = fmt::format(
        "**The front had not come to rest when the run ended:** it moved by {:.2g} m in the last "
        "{:g} s. The kinetic energy came to rest after {:.1f} s ({}).",
        f.front_change, f.rest.window, f.time_at_rest, energy);
  else
    return "**The flow had not come to rest when the run ended.**";
  if (f.last_speed >= told)
    out += fmt::format(" At its end the fastest point still moved at {:.2f} m/s{}.", f.last_speed,
                       is_set(f.front_at_rest)
                           ? fmt::format(", the front by {:.2g} m in the last {:g} s",
                                         f.front_change, f.rest.window)
                           : "");
  return out;
}

}  // namespace

std::string number(double value, int decimals, std::string_view unit) {
  if (!is_set(value)) return "-";
  return fmt::format("{:.{}f}{}{}", value, decimals, unit.empty() ? "" : " ", unit);
}

double past_toe(const ReportFacts& f, double x) {
  return is_set(f.toe) ? std::max(0.0, x - f.toe) : kUnset;
}

std::string summary_markdown(const ReportFacts& f, const ReportConfig& c) {
  std::string out = headline(f, c) + crest_sentence(f.outcome.crest);
  if (f.failed_volume <= 0.0)
    return out + fmt::format("No point of the materials that count moved by more than {:g} m.\n\n",
                             c.moved);
  out += fmt::format(
      "{:.0f} m³ per metre of width ({:.0f} % of the materials that count) moved by "
      "more than {:g} m; ",
      f.failed_volume, f.failed_percent, c.moved);
  out += fmt::format("the deepest of it lay at y = {:.1f} m. ", f.deepest_failed);
  if (f.runout > 0.0)
    out += fmt::format("{:.0f} m³ per metre came to lie beyond the toe. ", f.volume_past_toe);
  out += fmt::format("The fastest point reached {:.1f} m/s, the front {:.1f} m/s. ", f.peak_speed,
                     f.peak_front_speed);
  out += rest_sentence(f);
  return out + "\n\n";
}

std::string outcome_markdown(const ReportFacts& f, const ReportConfig& c) {
  const OutcomeFacts& o = f.outcome;
  const auto row = [](std::string_view name, const Apart& a) {
    return fmt::format("| {} | {:.2f} | {:.2f} | {:.2f} |\n", name, a.shaking, a.flow, a.both);
  };
  std::string out = fmt::format(
      "It **{}** (limits: {:g} m, {:g} m, {:g} x the height of {:.1f} m).\n\n"
      "| displacement (m) | shaking | flow | both |\n|---|---:|---:|---:|\n",
      word(o.outcome), c.stood, c.moved, c.flow_reach, o.height);
  out += row("mean of what counts", o.mean) + row("exceeded by 0.5 % of the mass", o.largest);
  if (is_set(o.crest.level)) {
    out += row(fmt::format("crest at x = {:.1f} m, outward", o.crest.x), o.crest.outward);
    out += row("crest, settlement", o.crest.settlement);
  }
  out += "\n";
  if (is_set(o.crest.freeboard))
    out += fmt::format("Freeboard left: {:.2f} m (crest at {:.2f} m before).\n\n",
                       o.crest.freeboard, o.crest.level);
  return out;
}

std::string foremost_markdown(const ReportFacts& f) {
  const Composition& c = f.composition;
  if (c.foremost.empty()) return "No material counts.\n\n";
  std::string out = "| material | share of the foremost 1 % of the mass |\n|---|---:|\n";
  for (const FrontShare& s : c.foremost)
    out += fmt::format("| {} | {:.0f} % |\n", cell(s.material), 100.0 * s.share);
  out += "\n";
  if (c.liquefied && is_set(f.toe))
    out += fmt::format(
        "Liquefied soil alone: runout {} by its fifth-farthest point, {} leaving out 0.5 % of its "
        "mass.\n\n",
        number(past_toe(f, c.liquefied_fronts.fifth), 2, "m"),
        number(past_toe(f, c.liquefied_fronts.q995), 2, "m"));
  return out;
}

std::string zone_shares_markdown(const ReportFacts& f) {
  if (f.zone_shares.empty()) return "";
  std::string out =
      "| r_u at the transfer | share of the area with residual strength |\n|---|---:|\n";
  double from = 0.0;
  for (const auto& [below, share] : f.zone_shares) {
    const std::string to = std::isfinite(below) ? fmt::format("to {:g}", below) : "and more";
    out += fmt::format("| {:g} {} | {:.1f} % |\n", from, to, 100.0 * share);
    from = below;
  }
  return out + "\n";
}

}  // namespace flowslide
