#include "study/page/varied.hpp"

#include "core/xml_text.hpp"
#include "study/page/labels.hpp"
#include "study/page/meanings.hpp"
#include "study/page/setting_meaning.hpp"
#include "study/statistics/summary.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/format.h>

namespace flowslide::study {
namespace {

/// Different texts of a column among the rows of the variant, in the order of the rows.
std::vector<std::string> values_of(const Column& c, const StudyFindings& f) {
  std::vector<std::string> values;
  for (const std::size_t g : f.groups) {
    const std::string& text = c.text[f.repeats.groups[g][0]];
    if (!text.empty() && std::find(values.begin(), values.end(), text) == values.end())
      values.push_back(text);
  }
  return values;
}

std::string values_text(const Column& c, const StudyFindings& f) {
  constexpr std::size_t kMost = 12;
  const std::vector<std::string> values = values_of(c, f);
  const std::string unit = c.unit.empty() ? "" : " " + c.unit;
  if (values.size() <= kMost) return fmt::format("{}{}", fmt::join(values, ", "), unit);
  if (!c.is_number) return fmt::format("{} values", values.size());
  double low = kUnset, high = kUnset;
  for (const std::size_t g : f.groups)
    if (const double v = c.number[f.repeats.groups[g][0]]; is_set(v)) {
      low = is_set(low) ? std::min(low, v) : v;
      high = is_set(high) ? std::max(high, v) : v;
    }
  return fmt::format("{} values, {} to {}{}", values.size(), short_number(low), short_number(high),
                     unit);
}

/// What the settings of an input are, each once, without the values that they may have, and their
/// names.
std::string meanings_of(const Plan& plan, const std::vector<std::string>& settings) {
  std::vector<std::string> found;
  for (const std::string& setting : settings) {
    std::string text = setting_meaning(plan, setting);
    text = text.substr(0, text.find(" (allowed"));
    if (!text.empty() && std::find(found.begin(), found.end(), text) == found.end())
      found.push_back(std::move(text));
  }
  return xml_text(fmt::format("{}", fmt::join(found, "; "))) + (found.empty() ? "" : "<br>") +
         "<code>" + xml_text(fmt::format("{}", fmt::join(settings, ", "))) + "</code>";
}

std::string inputs_table(const Plan& plan, const Table& table, const StudyFindings& f) {
  std::string rows;
  for (const Input& input : plan.inputs) {
    const Column* c = table.find(input.name);
    if (!c) continue;
    rows += fmt::format(
        "<tr><td class='word'>{}</td><td class='word'>{}</td><td class='word'>{}{}</td></tr>",
        xml_text(input.name), meanings_of(plan, input.settings), xml_text(values_text(*c, f)),
        input.sampled ? ", sampled" : "");
  }
  for (const Column& c : table.columns)
    if (c.role == Role::disturbance && c.name.starts_with("disturbed:"))
      rows += fmt::format(
          "<tr><td class='word'>disturbed by repeats</td><td class='word'>{}</td><td "
          "class='word'>by what means nothing to the dam</td></tr>",
          meanings_of(plan, {c.name.substr(c.name.find(':') + 1)}));
  if (rows.empty()) return "";
  return "<div class='wide'><table><tr><th class='word'>input</th><th class='word'>what it is</th>"
         "<th class='word'>values</th></tr>" +
         rows + "</table></div>";
}

/// Workflow of each variant, and what the study sets in all its rows.
std::string fixed_settings(const Plan& plan) {
  std::map<std::string, std::vector<const Row*>> variants;
  for (const Row& row : plan.rows) variants[row.variant].push_back(&row);
  std::string items;
  for (const auto& [variant, rows] : variants) {
    std::string set;
    for (const std::string& o : rows.front()->overrides) {
      const bool of_all = std::all_of(rows.begin(), rows.end(), [&](const Row* row) {
        return std::find(row->overrides.begin(), row->overrides.end(), o) != row->overrides.end();
      });
      if (of_all) set += (set.empty() ? "<code>" : ", <code>") + xml_text(o) + "</code>";
    }
    items += fmt::format("<li>{}: {}{}</li>", xml_text(variant),
                         xml_text(rows.front()->workflow.filename().string()),
                         set.empty() ? "" : " with " + set);
  }
  return "<p>Everything else is as in the workflows, and in the page of each run:</p><ul>" + items +
         "</ul>";
}

std::string definitions(const Table& table, const StudyFindings& f) {
  std::vector<std::string> names = f.results;
  for (const Relation& r : f.relations)
    if (std::find(names.begin(), names.end(), r.x) == names.end()) names.push_back(r.x);
  std::string items;
  for (const std::string& name : names) {
    const Column* c = table.find(name);
    const auto known = c && c->role == Role::found ? meaning_of(name) : std::nullopt;
    if (known)
      items += fmt::format("<li><b>{}</b>: {}.</li>", xml_text(readable(table, name)),
                           xml_text(known->definition));
  }
  if (items.empty()) return "";
  return "<details><summary>What the numbers mean</summary><ul>" + items + "</ul></details>";
}

/// The inputs of two to six values that move the first result, the strongest first.
std::vector<const Column*> strongest_inputs(const Table& table, const StudyFindings& f) {
  constexpr std::size_t kMost = 6;
  std::vector<const Swing*> swings;
  for (const Swing& s : f.swings)
    if (s.result == f.results.front()) swings.push_back(&s);
  std::stable_sort(swings.begin(), swings.end(), [](const Swing* a, const Swing* b) {
    return std::abs(a->effect.swing.value) > std::abs(b->effect.swing.value);
  });
  std::vector<const Column*> found;
  for (const Swing* s : swings) {
    const Column* c = table.find(s->input);
    const std::size_t n = values_of(*c, f).size();
    if (n > 1 && n <= kMost && found.size() < 2) found.push_back(c);
  }
  return found;
}

}  // namespace

std::string counted_rows(const Plan& plan) {
  std::map<std::string, std::size_t> rows, repeats;
  for (const Row& row : plan.rows) {
    ++rows[row.variant];
    repeats[row.variant] += row.repeat > 0;
  }
  std::string text;
  std::size_t repeated = 0;
  for (const auto& [variant, n] : rows) {
    repeated += repeats[variant];
    text += fmt::format("{}{} of {}", text.empty() ? ": " : ", ", n - repeats[variant],
                        xml_text(variant));
  }
  if (repeated > 0) text += fmt::format(", and {} repeats of them", repeated);
  return rows.size() > 1 || repeated > 0 ? text : "";
}

std::string what_was_varied(const Plan& plan, const Table& table, const StudyFindings& f) {
  return "<section id='varied'><h2>What was varied</h2>" + inputs_table(plan, table, f) +
         fixed_settings(plan) + definitions(table, f) + "</section>";
}

std::string levels_table(const Table& table, const StudyFindings& f) {
  if (f.results.empty()) return "";
  const std::vector<const Column*> by = strongest_inputs(table, f);
  if (by.size() < 2) return "";
  const auto head = [&](const Column& c, const std::string& value) {
    return xml_text(c.name + " " + value + (c.unit.empty() ? "" : " " + c.unit));
  };
  std::string html = fmt::format(
      "<div class='wide'><table><caption>{}: median (least to largest) of {} over the other "
      "inputs</caption><tr><th></th>",
      xml_text(readable(table, f.results.front())), xml_text(f.variant));
  const std::vector<std::string> columns = values_of(*by[1], f);
  for (const std::string& value : columns) html += "<th>" + head(*by[1], value) + "</th>";
  for (const std::string& line : values_of(*by[0], f)) {
    html += "</tr><tr><th class='word'>" + head(*by[0], line) + "</th>";
    for (const std::string& value : columns) {
      std::vector<double> here;
      for (const std::size_t g : f.groups) {
        const std::size_t row = f.repeats.groups[g][0];
        if (by[0]->text[row] == line && by[1]->text[row] == value && is_set(f.scatter[0].mean[g]))
          here.push_back(f.scatter[0].mean[g]);
      }
      html += here.empty()
                  ? "<td>-</td>"
                  : fmt::format("<td>{} ({} to {})</td>", short_number(quantile_of(here, 0.5)),
                                short_number(quantile_of(here, 0.0)),
                                short_number(quantile_of(here, 1.0)));
    }
  }
  return html + "</tr></table></div>";
}

}  // namespace flowslide::study
