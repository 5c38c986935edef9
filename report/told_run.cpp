#include "report/told_run.hpp"

#include "report/audit_table.hpp"
#include "report/settings_text.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace flowslide {
namespace {

using TableRows = std::vector<std::vector<std::string>>;

std::string told_table(const std::vector<std::string>& head, const TableRows& rows) {
  std::string out = "|", rule = "|";
  for (const std::string& text : head) {
    out += " " + cell(text) + " |";
    rule += "---|";
  }
  out += "\n" + rule + "\n";
  for (const auto& row : rows) {
    out += "|";
    for (const std::string& text : row) out += " " + cell(text) + " |";
    out += "\n";
  }
  return out + "\n";
}

/// "kPa" with as many digits as the number needs.
std::string kilopascal(double value) { return fmt::format("{:.3g} kPa", value / 1e3); }

/// Angles in degrees, stresses in kPa and MPa: canonical text is in SI.
std::string readable(const std::string& value) {
  double number = 0.0;
  const std::size_t space = value.find(' ');
  if (space == std::string::npos || value[0] == '[') return value;
  const std::string unit = value.substr(space + 1);
  try {
    number = std::stod(value.substr(0, space));
  } catch (const std::exception&) {
    return value;
  }
  constexpr double degree = 3.14159265358979323846 / 180.0;
  if (unit == "rad") return fmt::format("{:.4g} deg", number / degree);
  if (unit == "Pa" && std::abs(number) >= 1e9) return fmt::format("{:g} GPa", number / 1e9);
  if (unit == "Pa" && std::abs(number) >= 1e6) return fmt::format("{:g} MPa", number / 1e6);
  if (unit == "Pa" && std::abs(number) >= 1e3) return fmt::format("{:g} kPa", number / 1e3);
  return value;
}

std::string soils_table(const ToldStage& stage, std::string_view prefix) {
  const SettingsTable soils = settings_table(read_settings_text(stage.settings), prefix);
  if (soils.names.empty()) return "";
  std::vector<std::string> head{"parameter"};
  head.insert(head.end(), soils.names.begin(), soils.names.end());
  TableRows rows;
  for (const auto& [path, values] : soils.rows) {
    std::vector<std::string>& row = rows.emplace_back();
    row.push_back(path);
    for (const std::string& value : values) row.push_back(value.empty() ? "-" : readable(value));
  }
  return told_table(head, rows);
}

std::string told_motion(const ReportInputs& in) {
  const ToldStage* stage = find_stage(in.stages, "motion.prepare");
  if (!stage)
    return in.zone.transfer_frame < 0
               ? "No motion: the state at rest was transferred.\n\n"
               : "The motion was not made in this workflow and is not known to the report.\n\n";
  struct Measure {
    const char *key, *name, *unit;
    double scale;
  };
  constexpr std::array measures{
      Measure{"motion_pga_m_s2", "peak ground acceleration PGA", "g", 1.0 / 9.81},
      Measure{"motion_pgv_m_s", "peak ground velocity PGV", "m/s", 1.0},
      Measure{"motion_arias_m_s", "Arias intensity", "m/s", 1.0},
      Measure{"motion_d5_95_s", "significant duration D5-95", "s", 1.0},
      Measure{"motion_tm_s", "mean period Tm", "s", 1.0},
      Measure{"motion_cav_m_s", "cumulative absolute velocity CAV", "m/s", 1.0},
      Measure{"motion_masi_m_s", "modified acceleration spectrum intensity MASI", "m/s", 1.0},
      Measure{"motion_duration_s", "length of the record", "s", 1.0},
      Measure{"motion_dt_s", "time step of the record", "s", 1.0}};
  TableRows rows;
  for (const Measure& m : measures) {
    const double value = number_in(stage->facts, m.key);
    if (is_set(value)) rows.push_back({m.name, fmt::format("{:.3g} {}", value * m.scale, m.unit)});
  }
  std::string out = told_table({"measure of the motion", "value"}, rows);
  if (in.motion && !in.motion->origin.empty())
    out += fmt::format("Origin: {}.\n\n", cell(in.motion->origin));
  return out;
}

std::string told_mesh(const ReportInputs& in) {
  const QuadMesh& mesh = in.history.mesh();
  std::vector<double> size;
  for (std::size_t e = 0; e < mesh.num_elements(); ++e)
    size.push_back(std::sqrt(area(corners(mesh, mesh.nodes, e))));
  std::sort(size.begin(), size.end());
  TableRows rows{{"elements, nodes", fmt::format("{}, {}", mesh.num_elements(), mesh.num_nodes())}};
  if (!size.empty())
    rows.push_back({"size of an element (root of its area): smallest, median, largest",
                    fmt::format("{:.3g} m, {:.3g} m, {:.3g} m", size.front(), size[size.size() / 2],
                                size.back())});
  const std::vector<double>& times = in.history.times();
  if (times.size() > 1)
    rows.push_back({"stored states of the shaking",
                    fmt::format("{}, until {:.4g} s", times.size(), times.back())});
  return told_table({"mesh of the shaking", "value"}, rows);
}

std::string told_grid(const ReportInputs& in) {
  const ParticleSet& p = in.flow.initial();
  double volume = 0.0;
  for (const double v : p.volume) volume += v;
  TableRows rows{{"material points", fmt::format("{}", p.size())},
                 {"mean distance of points",
                  fmt::format("{:.3g} m", std::sqrt(volume / static_cast<double>(p.size())))},
                 {"stored states of the flow", fmt::format("{}", in.flow.num_frames())}};
  if (const ToldStage* flow = find_stage(in.stages, "mpm.run"))
    for (const auto& [key, name] : {std::pair{"cell", "cell size"},
                                    {"toe", "toe, x"},
                                    {"ground.friction", "friction of the ground"},
                                    {"transfer", "transfer of velocity"},
                                    {"basis", "basis"},
                                    {"softening.reference_length", "reference length of softening"},
                                    {"end", "longest flow"},
                                    {"damping", "damping"}})
      if (const std::string value = find_setting(flow->settings, key); !value.empty())
        rows.push_back({name, value});
  return told_table({"grid of the flow", "value"}, rows);
}

std::string told_strength(const ReportInputs& in) {
  std::string out;
  if (const ToldStage* stage = find_stage(in.stages, "transfer.zone")) {
    TableRows rows;
    for (const auto& row : rows_of(find_setting(stage->settings, "strength.table")))
      if (row.size() == 2) rows.push_back({kilopascal(row[0]), kilopascal(row[1])});
    if (!rows.empty())
      out += told_table({"initial vertical effective stress", "residual strength S_r"}, rows);
  }
  if (const ToldStage* map = find_stage(in.stages, "transfer.map"))
    if (const std::string ratio = find_setting(map->settings, "c_soft_ratio"); !ratio.empty())
      out += fmt::format(
          "c_soft / S_r = {}: the strength that is left of S_r after large strain.\n\n", ratio);
  return out;
}

/// Weighted with the area; over the liquefied elements.
struct Strength {
  double area = 0.0, mean = kUnset, low = kUnset, high = kUnset;
};

Strength strength_of(const ReportInputs& in) {
  Strength s;
  double sum = 0.0;
  const QuadMesh& mesh = in.history.mesh();
  for (std::size_t e = 0; e < mesh.num_elements(); ++e) {
    const double value = in.zone.strength[e];
    if (!in.zone.liquefied[e] || !is_set(value)) continue;
    const double a = area(corners(mesh, mesh.nodes, e));
    s.area += a;
    sum += a * value;
    if (!(s.low <= value)) s.low = value;
    if (!(s.high >= value)) s.high = value;
  }
  if (s.area > 0.0) s.mean = sum / s.area;
  return s;
}

/// Mean of strength / strength at transfer over the points that have one and moved.
double strength_left(const ReportInputs& in, const FinalState& end) {
  double mass = 0.0, sum = 0.0;
  const ParticleSet& p = in.flow.initial();
  for (std::size_t i = 0; i < p.size(); ++i) {
    if (!end.failed[i] || !is_set(end.strength_ratio[i])) continue;
    mass += p.mass[i];
    sum += p.mass[i] * end.strength_ratio[i];
  }
  return mass > 0.0 ? sum / mass : kUnset;
}

std::string how_sure(const ReportInputs& in, const ReportFacts& f) {
  std::string out = "**How sure**\n\n";
  out += fmt::format(
      "- Balances at the end: mass {:.1e}, energy {:.1e}, momentum {:.1e}. Small residuals show "
      "that "
      "the equations were solved, not that they are the right ones.\n",
      f.mass_error, f.energy_error, f.momentum_error);
  if (f.runout > 0.0)
    out += fmt::format(
        "- The choice of what counts as the front moves the runout by {:.1f} m: {:.1f} m by the "
        "fifth-farthest point, {:.1f} m by mass.\n",
        std::abs(f.runout - f.runout_mass), f.runout, f.runout_mass);
  if (in.zone.transfer_frame >= 0)
    out +=
        "- This is one run. A dam that liquefies makes metres of the last digit of its motion: "
        "the scatter shows in runs whose motion differs by one part in a million and whose grid "
        "is shifted within a cell, and no number of this page should be quoted without it.\n";
  else
    out += "- This is one run. Its scatter shows in runs whose grid is shifted within a cell.\n";
  out +=
      "- One run cannot show what the size of cells and elements does: halve both and compare.\n\n";
  return out;
}

/// Whole per cent, without a sign at 0.
double percent(double part, double whole) { return std::round(100.0 * part / whole) + 0.0; }

std::string why(const ReportInputs& in, const ReportFacts& f, const FinalState& end) {
  std::string out = "**Why**\n\n";
  const Strength s = strength_of(in);
  const std::string_view did = in.zone.is_assumed() ? "is assumed to liquefy" : "liquefied";
  for (const auto& [window, depth] : f.liquefaction_depth)
    out += fmt::format("- {} soil {} to a depth of {:.1f} m.\n",
                       window == kWholeSoil ? "The" : fmt::format("Under the {} the", cell(window)),
                       did, depth);
  if (s.area > 0.0)
    out += fmt::format(
        "- {:.0f} m² of the section {}; its residual strength is {:.3g} kPa on average "
        "({:.3g} to {:.3g} kPa).\n",
        s.area, did, s.mean / 1e3, s.low / 1e3, s.high / 1e3);
  else
    out += "- Nothing of the section liquefied.\n";
  if (const double left = strength_left(in, end); is_set(left))
    out += fmt::format("- Where it failed, {:.0f} % of that strength was left at the end.\n",
                       100.0 * left);
  const MpmSample& last = in.flow.samples().back();
  if (last.gravity_work > 0.0)
    out += fmt::format(
        "- Gravity did {:.3g} MJ per metre of width; {:.0f} % of it went into the soil, {:.0f} % "
        "into friction on the ground, {:.0f} % into damping and transfer.\n",
        last.gravity_work / 1e6, percent(last.plastic_work, last.gravity_work),
        percent(last.friction_work, last.gravity_work),
        percent(last.damping_work, last.gravity_work));
  out += fmt::format("- The moment of transfer: {}.\n\n", cell(in.zone.transfer_reason));
  return out;
}

std::string what_changes(const ReportInputs& in) {
  TableRows rows;
  const Strength s = strength_of(in);
  if (s.area > 0.0)
    rows.push_back(
        {"residual strength S_r", fmt::format("{:.3g} kPa on average", s.mean / 1e3), "lower"});
  const ToldStage* map = find_stage(in.stages, "transfer.map");
  const ToldStage* flow = find_stage(in.stages, "mpm.run");
  const auto add = [&](const ToldStage* stage, const char* key, const char* name, const char* way) {
    const std::string value = stage ? find_setting(stage->settings, key) : "";
    if (!value.empty()) rows.push_back({name, value, way});
  };
  add(map, "c_soft_ratio", "softening c_soft / S_r", "lower");
  if (s.area > 0.0)
    rows.push_back(
        {"liquefied part of the section", fmt::format("{:.0f} m²", s.area), "deeper, wider"});
  if (const ToldStage* motion = find_stage(in.stages, "motion.prepare"))
    rows.push_back({"motion",
                    fmt::format("PGA {:.2g} g, Tm {:.2g} s",
                                number_in(motion->facts, "motion_pga_m_s2") / 9.81,
                                number_in(motion->facts, "motion_tm_s")),
                    "stronger, of longer period: more liquefies"});
  if (in.zone.transfer_frame >= 0)
    rows.push_back({"time of transfer", fmt::format("{:.4g} s", in.zone.transfer_time),
                    "not known beforehand: compare transfers 1 s apart"});
  add(flow, "ground.friction", "friction of the ground", "lower");
  add(flow, "cell", "cell size", "not known beforehand: halve it");
  return "**What would change it**\n\n" +
         told_table({"assumption", "in this run", "runs out farther if"}, rows);
}

}  // namespace

Table ground_line(const std::vector<ToldStage>& stages) {
  Table line{.columns = 2, .values = {}};
  const ToldStage* flow = find_stage(stages, "mpm.run");
  if (!flow) return line;
  for (const auto& row : rows_of(find_setting(flow->settings, "ground.surface")))
    if (row.size() == 2) line.add({row[0], row[1]});
  return line;
}

std::vector<std::pair<int, std::string>> soil_names(const std::vector<ToldStage>& stages) {
  std::vector<std::pair<int, std::string>> names;
  for (const auto& [uses, key] : {std::pair{"transfer.map", "tags"}, {"mesh.section", "tag"}}) {
    const ToldStage* stage = find_stage(stages, uses);
    if (!stage || !names.empty()) continue;
    const SettingsTable soils = settings_table(read_settings_text(stage->settings), "materials");
    for (const auto& [path, values] : soils.rows)
      for (std::size_t k = 0; path == key && k < values.size(); ++k)
        // One tag, or a list of them.
        for (const auto& row : rows_of("[[" + values[k].substr(values[k].starts_with('[')) + "]"))
          for (const double tag : row) names.emplace_back(static_cast<int>(tag), soils.names[k]);
  }
  return names;
}

std::string told_judgement(const ReportInputs& in, const ReportConfig&, const ReportFacts& facts,
                           const FinalState& end) {
  return how_sure(in, facts) + why(in, facts, end) + what_changes(in);
}

std::string told_inputs(const ReportInputs& in) {
  std::string out = told_motion(in) + told_mesh(in);
  if (const ToldStage* shake = find_stage(in.stages, "fem.run"))
    if (const std::string soils = soils_table(*shake, "materials"); !soils.empty())
      out += "**Soils in the shaking**\n\n" + soils;
  if (const std::string strength = told_strength(in); !strength.empty())
    out += "**Residual strength**\n\n" + strength;
  if (const ToldStage* map = find_stage(in.stages, "transfer.map"))
    if (const std::string soils = soils_table(*map, "materials"); !soils.empty())
      out += "**Soils in the flow**\n\n" + soils;
  return out + told_grid(in);
}

std::string told_settings(const ToldStage& stage) {
  TableRows rows;
  for (const Setting& s : read_settings_text(stage.settings)) rows.push_back({s.path, s.value});
  return told_table({"setting", "value"}, rows);
}

}  // namespace flowslide
