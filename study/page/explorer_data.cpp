#include "study/page/explorer_data.hpp"

#include "study/page/labels.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace flowslide::study {
namespace {

using ExplorerJson = nlohmann::ordered_json;

constexpr std::size_t kMostWords = 40;  ///< of a column; beyond it words are a name of the row

/// Six digits: more of them nobody reads from a chart.
ExplorerJson shortened(double v) {
  if (!std::isfinite(v)) return nullptr;
  return std::strtod(fmt::format("{:.6g}", v).c_str(), nullptr);
}

/// Where a column stands in the lists of the chart.
std::string group_of(const Column& c, const StudyFindings& f) {
  if (c.role == Role::input) return "Inputs";
  if (std::find(f.results.begin(), f.results.end(), c.name) != f.results.end()) return "Results";
  if (c.role == Role::found) return "Found by " + c.source;
  return "Rows";
}

ExplorerJson column_json(const Column& c, const Table& table, const StudyFindings& f) {
  const std::string label = readable(table, c.name), unit = c.unit;
  ExplorerJson json{{"name", c.name},
                    {"label", label.substr(0, label.rfind(" ["))},
                    {"unit", unit},
                    {"group", group_of(c, f)}};
  if (c.is_number) {
    if (std::none_of(c.number.begin(), c.number.end(), is_set)) return nullptr;
    const bool same = std::all_of(c.number.begin(), c.number.end(),
                                  [&](double v) { return v == c.number.front(); });
    if (same) {
      json["group"] = "The same in all rows";
      json["same"] = shortened(c.number.front());
      return json;
    }
    for (const double v : c.number) json["values"].push_back(shortened(v));
    return json;
  }
  std::vector<std::string> words;
  for (const std::string& text : c.text)
    if (!text.empty() && std::find(words.begin(), words.end(), text) == words.end())
      words.push_back(text);
  if (words.size() < 2 || words.size() > kMostWords) return nullptr;
  for (const std::string& text : c.text) {
    const auto at = std::find(words.begin(), words.end(), text);
    json["values"].push_back(at == words.end() ? ExplorerJson(nullptr)
                                               : ExplorerJson(at - words.begin()));
  }
  json["words"] = words;
  return json;
}

}  // namespace

std::string explorer_json(const Plan& plan, const Table& table, const StudyFindings& f,
                          const StudyAbout& about, const ExplorerStart& start) {
  ExplorerJson labels = ExplorerJson::array(), pages = ExplorerJson::array(),
               columns = ExplorerJson::array();
  for (std::size_t r = 0; r < table.rows; ++r) {
    labels.push_back(row_title(plan.rows[r]));
    pages.push_back(r < about.reports.size() ? about.reports[r] : "");
  }
  std::vector<std::size_t> group(table.rows);
  for (std::size_t g = 0; g < f.repeats.groups.size(); ++g)
    for (const std::size_t row : f.repeats.groups[g]) group[row] = g;
  std::vector<ExplorerJson> found;
  for (const Column& c : table.columns) {
    const bool told = c.role == Role::input || c.role == Role::found || c.name == "variant";
    if (const ExplorerJson json = told ? column_json(c, table, f) : nullptr; !json.is_null())
      found.push_back(json);
  }
  // Inputs and results first, what does not change last.
  const auto place = [](const ExplorerJson& c) {
    const std::string name = c["group"];
    return name == "Inputs" ? 0 : name == "Results" ? 1 : name == "The same in all rows" ? 3 : 2;
  };
  std::stable_sort(found.begin(), found.end(), [&](const ExplorerJson& a, const ExplorerJson& b) {
    return place(a) < place(b);
  });
  for (const ExplorerJson& c : found) columns.push_back(c);
  const ExplorerJson json{{"labels", labels},
                          {"pages", pages},
                          {"embedded", about.embedded.has_value()},
                          {"groups", group},
                          {"columns", columns},
                          {"start", {{"x", start.x}, {"y", start.y}, {"colour", start.colour}}}};
  // What is no UTF-8 (a label from a file of the user) must not stop the page.
  return json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

}  // namespace flowslide::study
