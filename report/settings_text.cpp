#include "report/settings_text.hpp"

#include "core/check.hpp"

#include <algorithm>
#include <charconv>

#include <nlohmann/json.hpp>

namespace flowslide {
namespace {

/// Splits `"NAME".rest`; the name may hold escaped quotes. False if it is nothing like that.
bool split_name(std::string_view text, std::string& name, std::string& rest) {
  if (text.empty() || text[0] != '"') return false;
  name.clear();
  std::size_t i = 1;
  for (; i < text.size() && text[i] != '"'; ++i) {
    if (text[i] == '\\' && i + 1 < text.size()) ++i;
    name += text[i];
  }
  if (i + 1 >= text.size() || text[i + 1] != '.') return false;
  rest = text.substr(i + 2);
  return true;
}

template <class List>
std::size_t place_of(List& list, const std::string& name, auto&& same, auto&& make) {
  const auto at =
      std::find_if(list.begin(), list.end(), [&](const auto& e) { return same(e, name); });
  if (at != list.end()) return static_cast<std::size_t>(at - list.begin());
  list.push_back(make(name));
  return list.size() - 1;
}

}  // namespace

std::vector<Setting> read_settings_text(std::string_view text) {
  std::vector<Setting> settings;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    const std::string_view line = text.substr(at, end - at);
    at = end + 1;
    const std::size_t sign = line.find(" = ");
    if (sign != std::string_view::npos)
      settings.push_back({std::string(line.substr(0, sign)), std::string(line.substr(sign + 3))});
    else if (!settings.empty())
      settings.back().value += "\n" + std::string(line);
  }
  return settings;
}

const ToldStage* find_stage(const std::vector<ToldStage>& stages, std::string_view uses) {
  const auto at = std::find_if(stages.begin(), stages.end(),
                               [&](const ToldStage& s) { return s.uses == uses; });
  return at == stages.end() ? nullptr : &*at;
}

std::string find_setting(std::string_view settings, std::string_view path) {
  for (const Setting& s : read_settings_text(settings))
    if (s.path == path) return s.value;
  return "";
}

std::vector<std::vector<double>> rows_of(std::string_view value) {
  std::vector<std::vector<double>> rows;
  if (!value.starts_with("[[")) return rows;
  int depth = 0;
  const char* const end = value.data() + value.size();
  for (const char* c = value.data(); c < end;) {
    if (*c == '[' && ++depth > 2) return {};
    if (*c == '[' && depth == 2) rows.emplace_back();
    if (*c == ']') --depth;
    double number = 0.0;
    const auto [after, error] = std::from_chars(c, end, number);
    if (error != std::errc{}) {
      ++c;
      continue;
    }
    if (depth != 2) return {};
    rows.back().push_back(number);
    // The rest of the entry is its unit, and a unit may hold digits: "kg/m3".
    for (c = after; c < end && *c != ',' && *c != ']';) ++c;
  }
  return rows;
}

SettingsTable settings_table(const std::vector<Setting>& settings, std::string_view prefix) {
  SettingsTable table;
  std::string name, rest;
  for (const Setting& s : settings) {
    if (!s.path.starts_with(prefix) || s.path.size() <= prefix.size() + 1) continue;
    if (!split_name(std::string_view(s.path).substr(prefix.size() + 1), name, rest)) continue;
    if (s.value == "given") continue;  // what is in it follows
    const std::size_t column = place_of(
        table.names, name, [](const auto& a, const auto& b) { return a == b; },
        [](const auto& n) { return n; });
    using Row = std::pair<std::string, std::vector<std::string>>;
    const std::size_t row = place_of(
        table.rows, rest, [](const Row& a, const auto& b) { return a.first == b; },
        [](const auto& n) {
          return Row{n, {}};
        });
    auto& cells = table.rows[row].second;
    cells.resize(std::max(cells.size(), column + 1));
    cells[column] = s.value;
  }
  for (auto& [path, cells] : table.rows) cells.resize(table.names.size());
  return table;
}

double number_in(std::string_view json, const std::string& key) {
  const auto parsed = nlohmann::json::parse(json, nullptr, false);
  if (!parsed.is_object() || !parsed.contains(key) || !parsed[key].is_number()) return kUnset;
  return parsed[key].get<double>();
}

}  // namespace flowslide
