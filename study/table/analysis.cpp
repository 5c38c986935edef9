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

/// Depths of liquefaction, one per window: of several definitions that with the shortest name.
std::vector<std::string> depths(const Table& table) {
  std::vector<std::string> all, result;
  for (const Column& c : table.columns)
    if (c.role == Role::found && c.is_number && c.name.starts_with("liquefaction_depth_"))
      all.push_back(c.name);
  for (const std::string& name : all)
    if (std::none_of(all.begin(), all.end(), [&](const std::string& other) {
          return other != name && name.starts_with(other.substr(0, other.size() - 1));
        }))
      result.push_back(name);
  return result;
}

std::vector<std::string> usual_results(const Table& table) {
  std::vector<std::string> results;
  for (const char* name : {"runout_m", "runout_mass_quantile_m", "volume_past_toe_m3_per_m"})
    if (const Column* c = table.find(name); c && c->role == Role::found && c->is_number)
      results.emplace_back(name);
  for (std::string& name : depths(table)) results.push_back(std::move(name));
  return results;
}

class Analyst {
 public:
  Analyst(const Plan& plan, const Table& table, const std::atomic<bool>* stop)
      : plan_(plan), table_(table), resampling_(plan.analysis.seed, stop) {
    f_.repeats = group_rows(groups_of(plan));
    choose_variant();
    f_.results = plan.analysis.results.empty() ? usual_results(table) : plan.analysis.results;
    std::erase_if(f_.results,
                  [&](const std::string& name) { return !is_there(name, "analysis.results"); });
  }

  StudyFindings run() {
    for (const std::string& result : f_.results) {
      const Column& c = *table_.find(result);
      f_.scatter.push_back(scatter(f_.repeats, distinct(c)));
      f_.exceedance.push_back(exceedance_of(c));
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

  /// What each row has found, once for each group: repeats that did not disturb the stage that
  /// found it are no repeats of it.
  [[nodiscard]] std::vector<double> distinct(const Column& c) const {
    std::vector<double> result = c.number;
    if (c.node.empty()) return result;
    for (const auto& rows : f_.repeats.groups) {
      std::set<std::size_t> seen;
      for (const std::size_t row : rows)
        if (is_set(result[row]) && !seen.insert(c.node[row]).second) result[row] = kUnset;
    }
    return result;
  }

  /// All that the groups of the variant have observed, every repeat and what one stage has found
  /// once, each group with the weight 1.
  [[nodiscard]] Exceedance exceedance_of(const Column& c) const {
    const std::vector<double> values = distinct(c);
    std::set<std::size_t> seen;
    std::vector<Weighted> observed;
    for (const std::size_t g : f_.groups) {
      std::vector<double> here;
      for (const std::size_t row : f_.repeats.groups[g])
        if (is_set(values[row]) && (c.node.empty() || seen.insert(c.node[row]).second))
          here.push_back(values[row]);
      for (const double v : here) observed.push_back({v, 1.0 / static_cast<double>(here.size())});
    }
    return exceedance(std::move(observed));
  }

  /// Mean of each group of the variant, over its repeats.
  [[nodiscard]] std::vector<double> means(const Column& c) const {
    const std::vector<double> values = distinct(c);
    std::vector<double> result;
    for (const std::size_t g : f_.groups) {
      std::vector<double> here;
      for (const std::size_t row : f_.repeats.groups[g])
        if (is_set(values[row])) here.push_back(values[row]);
      result.push_back(mean(here));
    }
    return result;
  }

  /// The groups that are one observation of y each. What one stage has found is one observation,
  /// however many rows take it on to other stages: it counts once for each x, which `label` tells.
  template <class Label>
  [[nodiscard]] std::vector<std::size_t> observations(const Column& y, Label&& label) const {
    std::set<std::pair<decltype(label(std::size_t{})), std::size_t>> seen;
    std::vector<std::size_t> places;
    const std::vector<double> result = means(y);
    for (std::size_t i = 0; i < f_.groups.size(); ++i) {
      if (!is_set(result[i])) continue;
      const std::size_t row = f_.repeats.groups[f_.groups[i]][0];
      if (y.node.empty() || seen.emplace(label(i), y.node[row]).second) places.push_back(i);
    }
    return places;
  }

  [[nodiscard]] Pairs observations(const Column& x, const Column& y) const {
    const std::vector<double> all_x = means(x), all_y = means(y);
    Pairs pairs;
    for (const std::size_t i : observations(y, [&](std::size_t k) { return all_x[k]; })) {
      if (!is_set(all_x[i])) continue;
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
    // How long a record goes on, and in what steps, is no measure of the motion.
    if (x.name.starts_with("motion_"))
      return x.name != "motion_dt_s" && x.name != "motion_duration_s";
    const std::vector<std::string> all = depths(table_);
    return std::find(all.begin(), all.end(), x.name) != all.end() &&
           !y.name.starts_with("liquefaction_depth_");
  }

  void relate(const Column& y) {
    for (const Column& x : table_.columns) {
      if (!is_cause(x, y)) continue;
      const Pairs p = observations(x, y);
      f_.relations.push_back(
          {x.name, y.name, spearman(p.x, p.y, resampling_), fit_line(p.x, p.y, resampling_)});
    }
  }

  void add_swing(const Input& input, const Column& y) {
    const Column& x = *table_.find(input.name);
    if (!feeds(x, y)) return;
    Effect effect;
    if (input.unit) {
      const Pairs p = observations(x, y);
      effect = effect_of_number(p.x, p.y, resampling_);
    } else {
      const std::vector<double> all = means(y);
      const auto word = [&](std::size_t i) { return x.text[f_.repeats.groups[f_.groups[i]][0]]; };
      std::vector<std::string> words;
      std::vector<double> result;
      for (const std::size_t i : observations(y, word)) {
        words.push_back(word(i));
        result.push_back(all[i]);
      }
      effect = effect_of_choice(words, result, resampling_);
    }
    if (is_set(effect.swing.value)) f_.swings.push_back({input.name, y.name, effect});
  }

  void add_thresholds() {
    auto pairs = plan_.analysis.thresholds;
    if (pairs.empty() && table_.find("runout_m"))
      for (const std::string& name : depths(table_)) pairs.emplace_back(name, "runout_m");
    for (const auto& [x, y] : pairs) {
      if (!is_there(x, "analysis.thresholds") || !is_there(y, "analysis.thresholds")) continue;
      add_thresholds(*table_.find(x), *table_.find(y));
    }
  }

  void add_thresholds(const Column& x, const Column& y) {
    struct Level {
      std::size_t row = 0;
      Pairs pairs;
    };
    const std::set<std::string> by = beside(x, y);
    const std::vector<double> all_x = means(x), all_y = means(y);
    std::map<std::string, Level> levels;
    for (const std::size_t i : observations(y, [&](std::size_t k) { return all_x[k]; })) {
      if (!is_set(all_x[i])) continue;
      const std::size_t row = f_.repeats.groups[f_.groups[i]][0];
      Level& level =
          levels.try_emplace(place_of(plan_.rows[row], by), Level{row, {}}).first->second;
      level.pairs.x.push_back(all_x[i]);
      level.pairs.y.push_back(all_y[i]);
    }
    std::erase_if(levels, [](const auto& l) { return l.second.pairs.x.size() < kFewestForRamp; });
    for (const auto& [where, level] : levels)
      f_.thresholds.push_back({x.name, y.name, where.empty() ? "" : *by.begin(), where, level.row,
                               fit_ramp(level.pairs.x, level.pairs.y, resampling_)});
    if (!levels.empty()) return;
    const Pairs p = observations(x, y);
    f_.thresholds.push_back({x.name, y.name, "", "", 0, fit_ramp(p.x, p.y, resampling_)});
  }

  /// Inputs of few values that y hangs on and x does not.
  [[nodiscard]] std::set<std::string> beside(const Column& x, const Column& y) const {
    constexpr std::size_t kMost = 6;
    std::set<std::string> names;
    for (const Input& input : plan_.inputs) {
      const Column& c = *table_.find(input.name);
      std::set<std::string> values;
      for (const std::size_t g : f_.groups) values.insert(c.text[f_.repeats.groups[g][0]]);
      const bool moves_x = x.role == Role::input ? &c == &x : feeds(c, x);
      if (values.size() > 1 && values.size() <= kMost && !moves_x && feeds(c, y))
        names.insert(input.name);
    }
    return names;
  }

  void compare() {
    std::set<std::string> variants;
    for (const Row& row : plan_.rows)
      if (row.variant != f_.variant) variants.insert(row.variant);
    for (const std::string& variant : variants)
      for (const std::string& result : f_.results) compare_with(variant, *table_.find(result));
  }

  /// Names of the inputs that rows of a variant have.
  [[nodiscard]] std::set<std::string> inputs_of(const std::string& variant) const {
    std::set<std::string> names;
    for (const Row& row : plan_.rows)
      if (row.variant == variant)
        for (const auto& [name, value] : row.values) names.insert(name);
    return names;
  }

  /// The values of a row for inputs that both variants have; "0.30 g" is 0.3 g.
  [[nodiscard]] static std::string place_of(const Row& row, const std::set<std::string>& shared) {
    std::string where;
    for (const auto& [name, value] : row.values) {
      if (!shared.contains(name)) continue;
      const auto amount = parse_amount(value);
      where += fmt::format("{}{} {}", where.empty() ? "" : ", ", name,
                           amount ? to_text(*amount) : value);
    }
    return where;
  }

  void compare_with(const std::string& variant, const Column& c) {
    std::set<std::string> shared = inputs_of(variant);
    const std::set<std::string> own = inputs_of(f_.variant);
    std::erase_if(shared, [&](const std::string& name) { return !own.contains(name); });
    // Values of both sides by the inputs that they share.
    std::map<std::string, std::array<std::vector<double>, 2>> by_values;
    std::array<std::vector<double>, 2> all;
    std::array<std::size_t, 2> groups{};
    const std::vector<double> values = distinct(c);
    for (const auto& rows : f_.repeats.groups) {
      const Row& row = plan_.rows[rows[0]];
      if (row.variant != f_.variant && row.variant != variant) continue;
      std::vector<double> here;
      for (const std::size_t r : rows)
        if (is_set(values[r])) here.push_back(values[r]);
      if (here.empty()) continue;
      const std::size_t side = row.variant == variant;
      ++groups[side];
      by_values[place_of(row, shared)][side].push_back(mean(here));
    }
    std::erase_if(by_values, [](const auto& entry) {
      return entry.second[0].empty() || entry.second[1].empty();
    });
    if (by_values.empty()) {
      tell_not_compared(variant, c, groups, shared);
      return;
    }
    for (const auto& [where, sides] : by_values) {
      for (std::size_t s = 0; s < 2; ++s)
        all[s].insert(all[s].end(), sides[s].begin(), sides[s].end());
      f_.comparisons.push_back(
          {variant, c.name, where, ratio_of_means(sides[0], sides[1], resampling_)});
    }
    if (by_values.size() > 1)
      f_.comparisons.push_back({variant, c.name, "", ratio_of_means(all[0], all[1], resampling_)});
  }

  void tell_not_compared(const std::string& variant, const Column& c,
                         const std::array<std::size_t, 2>& groups,
                         const std::set<std::string>& shared) {
    for (std::size_t side = 0; side < 2; ++side)
      if (groups[side] == 0) {
        f_.not_compared.push_back(
            {variant, c.name,
             fmt::format("no row of {} has found a {}", side == 0 ? f_.variant : variant, c.name)});
        return;
      }
    f_.not_compared.push_back({variant, c.name,
                               fmt::format("no row of {} has the values of a row of {} in {}",
                                           f_.variant, variant, fmt::join(shared, ", "))});
  }

  const Plan& plan_;
  const Table& table_;
  Resampling resampling_;
  StudyFindings f_;
};

}  // namespace

StudyFindings analyse(const Plan& plan, const Table& table, const std::atomic<bool>* stop) {
  return Analyst(plan, table, stop).run();
}

}  // namespace flowslide::study
