#include "study/table/table.hpp"

#include "workflows/engine/sealed_json.hpp"
#include "workflows/engine/warnings.hpp"

#include <algorithm>
#include <array>
#include <map>

#include <fmt/format.h>

namespace flowslide::study {
namespace {

/// How long a computation took hangs on the machine and its load.
constexpr std::array<std::string_view, 3> kTimes{"fem_seconds", "flow_point_updates_per_s",
                                                 "warnings"};

/// These first, so that they are found at once.
constexpr std::array<std::string_view, 5> kFirst{"runout_m", "runout_mass_quantile_m",
                                                 "liquefaction_depth_pond_m",
                                                 "liquefaction_depth_crest_m", "transfer_time_s"};

/// Facts under one name each: those of a group as `crest.freeboard_m`, of a list whose items have
/// names as `regions.lower dam.failed_share`. Other lists have no place in a table.
void flatten(const std::string& name, const Json& value,
             std::vector<std::pair<std::string, Json>>& out) {
  const std::string inside = name.empty() ? "" : name + ".";
  if (value.is_object()) {
    for (const auto& [key, item] : value.items()) flatten(inside + key, item, out);
  } else if (value.is_array()) {
    for (const Json& item : value)
      if (item.is_object() && item.contains("name") && item["name"].is_string())
        for (const auto& [key, part] : item.items())
          if (key != "name")
            flatten(inside + item["name"].get<std::string>() + "." + key, part, out);
  } else if (value.is_number() || value.is_boolean() || value.is_string()) {
    out.emplace_back(name, value);
  }
}

std::vector<std::pair<std::string, Json>> flat_facts(const std::string& text) {
  std::vector<std::pair<std::string, Json>> facts;
  flatten("", Json::parse(text, nullptr, false), facts);
  std::erase_if(facts, [](const auto& fact) {
    return std::find(kTimes.begin(), kTimes.end(), fact.first) != kTimes.end();
  });
  return facts;
}

std::string without_numbers(std::string text) {
  std::erase_if(text, [](char c) {
    return (c >= '0' && c <= '9') || c == '.' || c == '-' || c == '+' || c == 'e';
  });
  return text;
}

std::string number_text(double value) { return fmt::format("{}", value); }

class Builder {
 public:
  Builder(const Plan& plan, const StudyState& progress) : plan_(plan), progress_(progress) {
    table_.rows = plan.rows.size();
  }

  Table build() {
    add_rows();
    add_inputs();
    add_disturbances();
    add_states();
    add_found();
    add_keys();
    return std::move(table_);
  }

 private:
  Column& add(std::string name, Role role, std::string unit, std::string source) {
    Column& c = table_.columns.emplace_back();
    c.name = std::move(name);
    c.role = role;
    c.unit = std::move(unit);
    c.source = std::move(source);
    c.text.resize(table_.rows);
    c.number.assign(table_.rows, kUnset);
    return c;
  }
  static void set(Column& c, std::size_t row, double value) {
    c.number[row] = value;
    c.text[row] = number_text(value);
    c.is_number = true;
  }

  void add_rows() {
    Column& number = add("row", Role::row, "", "place in the study file");
    for (std::size_t r = 0; r < table_.rows; ++r)
      set(number, r, static_cast<double>(plan_.rows[r].number));
    Column& id = add("id", Role::row, "", "digest of all settings and stages");
    for (std::size_t r = 0; r < table_.rows; ++r) id.text[r] = plan_.rows[r].id;
    Column& variant = add("variant", Role::row, "", "base, or its name under also");
    for (std::size_t r = 0; r < table_.rows; ++r) variant.text[r] = plan_.rows[r].variant;
  }

  void add_inputs() {
    for (const Input& input : plan_.inputs) {
      Column& c = add(input.name, Role::input, input.unit.value_or(""),
                      fmt::format("{}", fmt::join(input.settings, " ")));
      for (std::size_t r = 0; r < table_.rows; ++r)
        for (const auto& [name, label] : plan_.rows[r].values) {
          if (name != input.name) continue;
          const auto amount = input.unit ? parse_amount(label) : std::nullopt;
          if (amount)
            set(c, r, amount->value);
          else
            c.text[r] = label;
        }
    }
  }

  void add_disturbances() {
    Column& repeat = add("repeat", Role::disturbance, "", "realisation; 0 is undisturbed");
    for (std::size_t r = 0; r < table_.rows; ++r)
      set(repeat, r, static_cast<double>(plan_.rows[r].repeat));
    std::vector<std::string> paths;
    for (const Row& row : plan_.rows)
      for (const auto& [path, value] : row.disturbed)
        if (std::find(paths.begin(), paths.end(), path) == paths.end()) paths.push_back(path);
    for (const std::string& path : paths) {
      Column& c = add("disturbed:" + path, Role::disturbance, "", path);
      for (std::size_t r = 0; r < table_.rows; ++r)
        for (const auto& [p, value] : plan_.rows[r].disturbed)
          if (p == path) c.text[r] = value;
    }
  }

  void add_states() {
    std::vector<std::string> states, causes;
    for (const Row& row : plan_.rows) {
      const State s = progress_.row_state(row);
      states.emplace_back(s == State::done ? "done" : s == State::failed ? "failed" : "open");
      const std::string text = progress_.cause(row);
      causes.push_back(text.substr(0, text.find('\n')));
    }
    add("state", Role::state, "", "done, failed or open").text = std::move(states);
    add("cause", Role::state, "", "of a failure").text = std::move(causes);
  }

  /// Of its settings, and of what it found.
  void add_warnings(std::size_t row, const WorkflowStage& stage, const StageRecord& result) {
    for (const std::string& text : warnings_of(stage, &result)) {
      const auto [it, is_new] =
          warning_.try_emplace(stage.name + without_numbers(text), table_.warnings.size());
      if (is_new) table_.warnings.push_back({stage.name, text, 0, {}});
      TableWarning& w = table_.warnings[it->second];
      ++w.rows;
      if (w.in.empty() || w.in.back() != row) w.in.push_back(row);
    }
  }

  /// The later stage counts, as in result.json.
  void add_found() {
    std::map<std::string, Column> columns;
    std::vector<std::string> order;
    for (std::size_t r = 0; r < table_.rows; ++r)
      for (const std::size_t n : plan_.rows[r].nodes) {
        const auto& finished = progress_.node(n).finished;
        if (!finished) continue;
        add_warnings(r, plan_.nodes[n].stage, finished->record);
        for (const auto& [name, value] : flat_facts(finished->record.facts)) {
          auto [it, is_new] = columns.try_emplace(name);
          Column& c = it->second;
          if (is_new) {
            order.push_back(name);
            // Names of facts are known only now: a variable may have one of them already.
            c.name = table_.find(name) ? "found:" + name : name;
            c.unit = unit_in_name(name);
            c.text.resize(table_.rows);
            c.number.assign(table_.rows, kUnset);
            c.node.assign(table_.rows, kNoNode);
          }
          const std::string before = c.text[r];
          if (value.is_string())
            c.text[r] = value.get<std::string>();
          else
            set(c, r,
                value.is_boolean() ? static_cast<double>(value.get<bool>()) : value.get<double>());
          // A report that says the same again has not found it.
          if (c.node[r] != kNoNode && c.text[r] == before) continue;
          const WorkflowStage& stage = plan_.nodes[n].stage;
          c.source = fmt::format("{} ({})", stage.name, stage.type.name);
          c.node[r] = n;
        }
      }
    for (const std::string_view name : kFirst)
      if (const auto it = columns.find(std::string(name)); it != columns.end()) {
        table_.columns.push_back(std::move(it->second));
        columns.erase(it);
      }
    for (const std::string& name : order)
      if (const auto it = columns.find(name); it != columns.end())
        table_.columns.push_back(std::move(it->second));
  }

  void add_keys() {
    std::vector<std::string> stages;
    for (const Node& node : plan_.nodes)
      if (std::find(stages.begin(), stages.end(), node.stage.name) == stages.end())
        stages.push_back(node.stage.name);
    for (const std::string& stage : stages) {
      Column& c = add("key:" + stage, Role::key, "", "key of its result, the folder in stages/");
      for (std::size_t r = 0; r < table_.rows; ++r)
        for (const std::size_t n : plan_.rows[r].nodes)
          if (plan_.nodes[n].stage.name == stage) c.text[r] = progress_.node(n).key.substr(0, 16);
    }
  }

  const Plan& plan_;
  const StudyState& progress_;
  std::map<std::string, std::size_t> warning_;  ///< place in table_.warnings
  Table table_;
};

}  // namespace

const Column* Table::find(std::string_view name) const {
  const auto it =
      std::find_if(columns.begin(), columns.end(), [&](const Column& c) { return c.name == name; });
  return it == columns.end() ? nullptr : &*it;
}

Table make_table(const Plan& plan, const StudyState& progress) {
  return Builder(plan, progress).build();
}

namespace {

/// How names end, and the units that this stands for; longer ones first.
constexpr std::array<std::pair<std::string_view, std::string_view>, 10> kUnits{
    {{"_m3_per_m", "m3/m"},
     {"_kg_per_m", "kg/m"},
     {"_j_per_m", "J/m"},
     {"_m_s2", "m/s2"},
     {"_m_s", "m/s"},
     {"_percent", "%"},
     {"_pa", "Pa"},
     {"_j", "J"},
     {"_m", "m"},
     {"_s", "s"}}};

}  // namespace

std::string unit_in_name(std::string_view name) {
  for (const auto& [ending, unit] : kUnits)
    if (name.ends_with(ending)) return std::string(unit);
  return "";
}

std::string without_unit(std::string_view name) {
  for (const auto& [ending, unit] : kUnits)
    if (name.ends_with(ending)) return std::string(name.substr(0, name.size() - ending.size()));
  return std::string(name);
}

}  // namespace flowslide::study
