#include "study/table/analysis.hpp"

#include "study/statistics/ranks.hpp"

#include <algorithm>
#include <map>
#include <set>

#include <fmt/format.h>

namespace flowslide::study {
namespace {

/// Rows that differ in their repeat only.
std::vector<std::size_t> groups_of(const Plan& plan) {
  std::map<std::string, std::size_t> known;
  std::vector<std::size_t> group;
  for (const Row& row : plan.rows) {
    std::string text = row.variant;
    for (const auto& [name, value] : row.values) text += "\n" + name + "=" + value;
    group.push_back(known.emplace(text, known.size()).first->second);
  }
  return group;
}

bool varies(const Column& c) {
  std::set<double> values;
  for (const double v : c.number)
    if (is_set(v)) values.insert(v);
  return values.size() > 1;
}

std::vector<std::string> usual_results(const Table& table) {
  std::vector<std::string> results;
  for (const Column& c : table.columns) {
    const bool usual = c.name == "runout_m" || c.name == "runout_mass_quantile_m" ||
                       c.name == "volume_past_toe_m3_per_m" ||
                       c.name.starts_with("liquefaction_depth_");
    if (c.role == Role::found && c.is_number && usual) results.push_back(c.name);
  }
  return results;
}

class Analyst {
 public:
  Analyst(const Plan& plan, const Table& table) : plan_(plan), table_(table) {
    f_.repeats = group_rows(groups_of(plan));
    choose_variant();
    f_.results = plan.analysis.results.empty() ? usual_results(table) : plan.analysis.results;
    std::erase_if(f_.results, [&](const std::string& name) {
      return !is_there(name, "analysis.results");
    });
  }

  StudyFindings run() {
    for (const std::string& result : f_.results) {
      const Column& c = *table_.find(result);
      f_.scatter.push_back(scatter(f_.repeats, c.number));
      f_.exceedance.push_back(exceedance(without_gaps(means(c), means(c)).x));
      relate(c);
      for (const Input& input : plan_.inputs) add_swing(input, c);
    }
    add_thresholds();
    compare();
    return std::move(f_);
  }

 private:
  /// Is there such a column of numbers? Where a row is done it has to be.
  [[nodiscard]] bool is_there(const std::string& name, std::string_view key) const {
    const Column* c = table_.find(name);
    if (c && c->is_number) return true;
    const std::vector<std::string>& states = table_.find("state")->text;
    if (std::find(states.begin(), states.end(), "done") == states.end()) return false;
    throw InputError(fmt::format(
        "{}: {}: the table has no column of numbers '{}'. Take one of its header, such as {}.",
        plan_.file.string(), key, name, fmt::join(usual_results(table_), ", ")));
  }

  void choose_variant() {
    std::map<std::string, std::size_t> count;
    for (const auto& rows : f_.repeats.groups) ++count[plan_.rows[rows[0]].variant];
    for (const auto& rows : f_.repeats.groups) {
      const std::string& name = plan_.rows[rows[0]].variant;
      if (f_.variant.empty() || count[name] > count[f_.variant]) f_.variant = name;
    }
    for (std::size_t g = 0; g < f_.repeats.groups.size(); ++g)
      if (plan_.rows[f_.repeats.groups[g][0]].variant == f_.variant) f_.groups.push_back(g);
  }

  /// Mean of each group of the variant.
  [[nodiscard]] std::vector<double> means(const Column& c) const {
    std::vector<double> result;
    for (const std::size_t g : f_.groups) {
      std::vector<double> here;
      for (const std::size_t row : f_.repeats.groups[g])
        if (is_set(c.number[row])) here.push_back(c.number[row]);
      result.push_back(mean(here));
    }
    return result;
  }

  /// x and y of the groups. What one stage has found is one observation, however many rows take
  /// it on to other stages: it counts once for each x.
  [[nodiscard]] Pairs observations(const Column& x, const Column& y) const {
    const std::vector<double> all_x = means(x), all_y = means(y);
    std::set<std::pair<double, std::size_t>> seen;
    Pairs pairs;
    for (std::size_t i = 0; i < f_.groups.size(); ++i) {
      const std::size_t row = f_.repeats.groups[f_.groups[i]][0];
      if (!is_set(all_x[i]) || !is_set(all_y[i])) continue;
      if (!y.node.empty() && !seen.emplace(all_x[i], y.node[row]).second) continue;
      pairs.x.push_back(all_x[i]);
      pairs.y.push_back(all_y[i]);
    }
    return pairs;
  }

  /// Does an input set a stage that found the result, or one before it?
  [[nodiscard]] bool feeds(const Column& x, const Column& y) const {
    const auto n = std::find_if(y.node.begin(), y.node.end(),
                                [](std::size_t node) { return node != kNoNode; });
    if (n == y.node.end()) return true;
    std::set<std::string> stages{plan_.nodes[*n].stage.name};
    for (const std::size_t before : plan_.nodes[*n].before)
      stages.insert(plan_.nodes[before].stage.name);
    for (const Input& input : plan_.inputs)
      if (input.name == x.name)
        for (const std::string& path : input.settings) {
          const std::string stage = path.substr(std::string_view("stages.").size());
          if (stages.contains(stage.substr(0, stage.find('.')))) return true;
        }
    return false;
  }

  [[nodiscard]] bool is_cause(const Column& x, const Column& y) const {
    if (&x == &y || !x.is_number || !varies(x)) return false;
    if (x.role == Role::input) return feeds(x, y);
    if (x.name.starts_with("motion_") && x.name != "motion_dt_s") return true;
    return x.name.starts_with("liquefaction_depth_") && !y.name.starts_with("liquefaction_depth_");
  }

  void relate(const Column& y) {
    for (const Column& x : table_.columns) {
      if (!is_cause(x, y)) continue;
      const Pairs p = observations(x, y);
      f_.relations.push_back({x.name, y.name, spearman(p.x, p.y, plan_.analysis.seed),
                              fit_line(p.x, p.y, plan_.analysis.seed)});
    }
  }

  void add_swing(const Input& input, const Column& y) {
    const Column& x = *table_.find(input.name);
    if (!feeds(x, y)) return;
    const std::vector<double> result = means(y);
    Effect effect;
    if (input.unit) {
      effect = effect_of_number(means(x), result, plan_.analysis.seed);
    } else {
      std::vector<std::string> words;
      for (const std::size_t g : f_.groups) words.push_back(x.text[f_.repeats.groups[g][0]]);
      effect = effect_of_choice(words, result, plan_.analysis.seed);
    }
    if (is_set(effect.swing.value)) f_.swings.push_back({input.name, y.name, effect});
  }

  void add_thresholds() {
    auto pairs = plan_.analysis.thresholds;
    if (pairs.empty() && table_.find("runout_m"))
      for (const Column& c : table_.columns)
        if (c.name.starts_with("liquefaction_depth_")) pairs.emplace_back(c.name, "runout_m");
    for (const auto& [x, y] : pairs) {
      if (!is_there(x, "analysis.thresholds") || !is_there(y, "analysis.thresholds")) continue;
      const Pairs p = observations(*table_.find(x), *table_.find(y));
      f_.thresholds.push_back({x, y, fit_ramp(p.x, p.y, plan_.analysis.seed)});
    }
  }

  void compare() {
    std::set<std::string> variants;
    for (const Row& row : plan_.rows)
      if (row.variant != f_.variant) variants.insert(row.variant);
    for (const std::string& variant : variants)
      for (const std::string& result : f_.results) compare_with(variant, *table_.find(result));
  }

  void compare_with(const std::string& variant, const Column& c) {
    // By the values of the inputs that both have.
    std::map<std::string, std::array<std::vector<double>, 2>> by_values;
    std::array<std::vector<double>, 2> all;
    std::set<std::string> shared;
    for (const Row& row : plan_.rows)
      if (row.variant == variant)
        for (const auto& [name, value] : row.values) shared.insert(name);
    for (std::size_t g = 0; g < f_.repeats.groups.size(); ++g) {
      const Row& row = plan_.rows[f_.repeats.groups[g][0]];
      if (row.variant != f_.variant && row.variant != variant) continue;
      std::string where;
      for (const auto& [name, value] : row.values)
        if (shared.contains(name)) where += (where.empty() ? "" : ", ") + name + " " + value;
      const std::size_t side = row.variant == variant;
      std::vector<double> here;
      for (const std::size_t r : f_.repeats.groups[g])
        if (is_set(c.number[r])) here.push_back(c.number[r]);
      if (here.empty()) continue;
      by_values[where][side].push_back(mean(here));
    }
    std::erase_if(by_values, [](const auto& entry) {
      return entry.second[0].empty() || entry.second[1].empty();
    });
    for (const auto& [where, sides] : by_values) {
      for (std::size_t s = 0; s < 2; ++s)
        all[s].insert(all[s].end(), sides[s].begin(), sides[s].end());
      f_.comparisons.push_back(
          {variant, c.name, where, ratio_of_means(sides[0], sides[1], plan_.analysis.seed)});
    }
    if (by_values.size() > 1)
      f_.comparisons.push_back(
          {variant, c.name, "", ratio_of_means(all[0], all[1], plan_.analysis.seed)});
  }

  const Plan& plan_;
  const Table& table_;
  StudyFindings f_;
};

}  // namespace

StudyFindings analyse(const Plan& plan, const Table& table) { return Analyst(plan, table).run(); }

}  // namespace flowslide::study
