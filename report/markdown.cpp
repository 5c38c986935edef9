#include "report/markdown.hpp"

#include "report/audit_table.hpp"
#include "report/markdown_outcome.hpp"
#include "report/told_run.hpp"

#include <algorithm>

namespace flowslide {
namespace {

using Rows = std::vector<std::pair<std::string, std::string>>;

std::string pair_table(std::string_view left, std::string_view right, const Rows& rows) {
  std::string out = fmt::format("| {} | {} |\n|---|---|\n", left, right);
  for (const auto& [name, value] : rows)
    out += fmt::format("| {} | {} |\n", cell(name), cell(value));
  return out + "\n";
}

std::string list(const std::vector<std::string>& items) {
  std::string out;
  for (const std::string& item : items) out += fmt::format("- {}\n", cell(item));
  return out + "\n";
}

std::string_view verdict(const Movement& m) {
  constexpr double little = 0.05;
  constexpr double most = 0.5;
  if (m.points == 0) return "holds no points";
  if (m.failed_share < little) return "stayed";
  return m.failed_share < most ? "failed in part" : "failed";
}

std::string movements_table(const std::vector<Movement>& list, std::string_view kind,
                            double moved) {
  std::string out = fmt::format(
      "| {} | | moved > {:g} m (share of mass) | mean displacement (m) | largest (m) | volume "
      "(m³/m) | points |\n|---|---|---:|---:|---:|---:|---:|\n",
      kind, moved);
  for (const Movement& m : list)
    out += fmt::format("| {} | {} | {:.1f} % | {:.2f} | {:.2f} | {:.0f} | {} |\n", cell(m.name),
                       verdict(m), 100.0 * m.failed_share, m.mean_displacement, m.max_displacement,
                       m.volume, m.points);
  return out + "\n";
}

std::string key_numbers(const ReportFacts& f, const ReportConfig& c) {
  Rows rows{
      {"runout (fifth-farthest point past the toe)",
       number(is_set(f.toe) ? f.runout : kUnset, 2, "m")},
      {fmt::format("runout leaving out {:g} % of the failed mass", 100.0 * c.mass_quantile),
       number(f.runout_mass, 2, "m")},
      {"the same of equal mass: 5 of the 7,400 points of the case study",
       number(past_toe(f, f.composition.fronts.equal_mass), 2, "m")},
      {"runout leaving out 0.5, 1, 5 % of the mass that counts",
       fmt::format("{}, {}, {}", number(past_toe(f, f.composition.fronts.q995), 2, "m"),
                   number(past_toe(f, f.composition.fronts.q99), 2, "m"),
                   number(past_toe(f, f.composition.fronts.q95), 2, "m"))},
      {"height at the end, y leaving out 0.5 % of the mass", number(f.composition.height, 2, "m")},
      {"toe, x", number(f.toe, 2, "m")},
      {"front, x (fifth-farthest point)", number(f.front, 2, "m")},
      {"farthest point, x", number(f.front_farthest, 2, "m")}};
  for (const auto& [window, depth] : f.liquefaction_depth)
    rows.emplace_back("depth of liquefaction, " + window_label(window), number(depth, 2, "m"));
  rows.insert(
      rows.end(),
      {{"transfer time from the start of the motion", number(f.transfer_time, 3, "s")},
       {"computed flow", number(f.duration, 2, "s")},
       {"front at rest after", number(f.front_at_rest, 2, "s")},
       {"kinetic energy at rest after", number(f.time_at_rest, 2, "s")},
       {fmt::format("way of the front in the last {:g} s", f.rest.window),
        number(f.front_change, 3, "m")},
       {"speed of the fastest point at the end", number(f.last_speed, 2, "m/s")},
       {"largest speed of a point", number(f.peak_speed, 2, "m/s")},
       {"largest speed of the front", number(f.peak_front_speed, 2, "m/s")},
       {"failed volume", number(f.failed_volume, 1, "m³/m")},
       {"failed share of the counted volume", number(f.failed_percent, 1, "%")},
       {"volume beyond the toe", number(f.volume_past_toe, 1, "m³/m")},
       {"mass beyond the toe", number(f.composition.mass_past_toe, 0, "kg/m")},
       {"deepest failed point, undeformed y", number(f.deepest_failed, 2, "m")},
       {fmt::format("the same leaving out {:g} % of the failed mass", 100.0 * c.mass_quantile),
        number(f.deepest_failed_mass, 2, "m")},
       {"mass that left through the outlet", number(f.mass_left, 0, "kg/m")},
       {"mass error", fmt::format("{:.2e}", f.mass_error)},
       {"energy error (residual / work of gravity)", fmt::format("{:.2e}", f.energy_error)},
       {"momentum error (residual / impulse of gravity)",
        fmt::format("{:.2e}", f.momentum_error)}});
  return pair_table("quantity", "value", rows);
}

std::string figures(const DrawnFigures& drawn) {
  if (drawn.figures.empty()) return "None were drawn.\n\n";
  std::string out;
  for (const Figure& figure : drawn.figures)
    out += fmt::format("![{0}](figures/{1}.png)\n\n{0} ([SVG](figures/{1}.svg))\n\n",
                       figure.caption, figure.name);
  return out;
}

std::string liquefaction(const ReportInputs& in, const ReportFacts& f) {
  const LiquefactionZone& zone = in.zone;
  const auto elements = std::count(zone.liquefied.begin(), zone.liquefied.end(), 1);
  double area_liquefied = 0.0;
  const QuadMesh& mesh = in.history.mesh();
  for (std::size_t e = 0; e < mesh.num_elements(); ++e)
    if (zone.liquefied[e]) area_liquefied += area(corners(mesh, mesh.nodes, e));
  std::string out =
      zone.transfer_frame < 0
          ? "The state at rest was transferred; there was no shaking to choose from.\n"
          : fmt::format("The state at t = {:.3f} s was transferred (frame {} of {}).\n",
                        zone.transfer_time, zone.transfer_frame + 1, in.history.times().size());
  out += fmt::format("Reason: {}\n\nThe liquefied zone has {} elements, {:.0f} m².\n\n",
                     cell(zone.transfer_reason), elements, area_liquefied);
  out += zone_shares_markdown(f);
  Rows rows;
  const auto add_depths = [&rows, &zone](const std::string& rule,
                                         const std::vector<double>& depth) {
    for (std::size_t w = 0; w < depth.size(); ++w)
      rows.emplace_back(window_label(zone.window_names[w]) + rule, number(depth[w], 2, "m"));
  };
  add_depths(", up to the transfer", zone.window_depth_max);
  add_depths(", where r_u passes the threshold between nodes", zone.window_depth_interpolated);
  add_depths(", the lowest single node", zone.window_depth_any);
  if (zone.transfer_frame >= 0) {
    add_depths(fmt::format(", until strong shaking ends ({:.1f} s)", zone.strong_shaking_end),
               zone.window_depth_strong);
    if (is_set(zone.onset_time))
      add_depths(fmt::format(", before the slide ({:.1f} s)", zone.onset_time),
                 zone.window_depth_before_slide);
  }
  if (!rows.empty()) out += pair_table("window", "largest depth of liquefaction", rows);
  if (!zone.notes.empty()) out += "Notes on the zone:\n\n" + list(zone.notes);
  out += fmt::format("Shaking read from: {}. Out-of-plane stress: {}.\n\n",
                     cell(in.history.origin().program), cell(in.history.origin().sigma_zz_rule));
  if (!in.history.origin().notes.empty())
    out += "Notes of the reader:\n\n" + list(in.history.origin().notes);
  return out;
}

std::string definitions(const ReportConfig& c, const RestRule& rest) {
  return fmt::format(
      "- Plane strain; volumes, masses and energies are per metre of width.\n"
      "- Runout: x of the fifth-farthest material point of the materials that count (all but the "
      "foundation) minus x of the toe of the undeformed section, at least 0.\n"
      "- Displacement: from the undeformed section; of the shaking up to the transfer, of the flow "
      "after it. Failed: moved by more than {0:g} m in both together.\n"
      "- Stood: less than 0.5 % of the mass moved more than {4:g} m. Deformed: less than {0:g} m. "
      "Slid: the flow carried less than 0.5 % of the mass farther than {5:g} x the height of the "
      "section. Flowed: farther. Crest: the downstream edge of the highest ground.\n"
      "- Depth of liquefaction: of the deepest node in a window whose pore-pressure ratio r_u "
      "exceeds the threshold of the zone stage, below its datum; largest value up to the "
      "transfer.\n"
      "- At rest: the front stays within {1:g} m to the end, for {2:g} s or more; the kinetic "
      "energy stays below {3:g} of its peak. A run ends by itself when both do, so its front may "
      "still creep by {1:g} m in {2:g} s.\n"
      "- Balance errors: at the end of the run; of mass the largest. The energy error contains "
      "what "
      "the time integration and the transfer between points and grid lost unaccounted for.\n\n",
      c.moved, rest.runout_change, rest.window, rest.kinetic_share, c.stood, c.flow_reach);
}

}  // namespace

std::string report_summary(const ReportFacts& facts, const ReportConfig& config) {
  return summary_markdown(facts, config);
}

std::vector<std::string> all_warnings(const ReportInputs& in, const ReportFacts& f) {
  std::vector<std::string> warnings = in.warnings;
  warnings.insert(warnings.end(), f.warnings.begin(), f.warnings.end());
  return warnings;
}

std::vector<ReportSection> report_sections(const ReportInputs& in, const ReportConfig& c,
                                           const ReportFacts& f, const FinalState& end) {
  std::string moved = movements_table(f.materials, "material", c.moved);
  if (!f.regions.empty()) moved += movements_table(f.regions, "region", c.moved);
  std::vector<ReportSection> sections{
      {"How sure, why, and what would change it", told_judgement(in, c, f, end)},
      {"Key numbers", key_numbers(f, c)},
      {"What became of the section", outcome_markdown(f, c)},
      {"What leads the flow", foremost_markdown(f)},
      {"What failed and what stayed", moved},
      {"Liquefied zone and transfer time", liquefaction(in, f)},
      {"What was computed", told_inputs(in)},
      {"Audit of the transfer", audit_tables(in.audit)},
      {"Definitions", definitions(c, in.flow.rest())}};
  Rows run = in.provenance;
  if (!in.date.empty()) run.insert(run.begin(), {"date of this report", in.date});
  if (!run.empty()) sections.push_back({"What was run", pair_table("item", "value", run)});
  return sections;
}

std::string report_markdown(const ReportInputs& in, const ReportConfig& c, const ReportFacts& f,
                            const FinalState& end, const DrawnFigures& drawn) {
  std::string out = fmt::format("# {}\n\n", cell(c.title)) + summary_markdown(f, c);
  const std::vector<std::string> warnings = all_warnings(in, f);
  if (!warnings.empty()) out += "## Read this before using the numbers\n\n" + list(warnings);
  out += "## Figures\n\n" + figures(drawn);
  for (const ReportSection& section : report_sections(in, c, f, end))
    out += fmt::format("## {}\n\n{}", section.title, section.text);
  out +=
      "## Files\n\n"
      "`facts.json` holds the key numbers, `runout.csv` and `zone.csv` the time series";
  if (c.page) out += ", `report.html` this report with charts and a player of the flow";
  if (c.paraview) out += ", `flow.pvd` and `zone.pvd` the fields for ParaView";
  out +=
      ". `data/` holds what the figures are drawn from. To restyle them, change the scripts in "
      "`plot/` of the run folder and run `python3 plot/plot.py` there.\n";
  return out;
}

}  // namespace flowslide
