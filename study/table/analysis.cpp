#include "study/table/analysis.hpp"

#include "study/statistics/ranks.hpp"
#include "study/table/comparison.hpp"
#include "study/table/observations.hpp"

#include <algorithm>
#include <map>
#include <set>

#include <fmt/format.h>

namespace flowslide::study {
namespace {

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
      : plan_(plan), table_(table), resampling_(plan.analysis.seed, stop), observed_(plan, table) {
    f_.variant = observed_.variant();
    f_.repeats = observed_.repeats();
    f_.groups = observed_.groups();
    f_.results = plan.analysis.results.empty() ? usual_results(table) : plan.analysis.results;
    std::erase_if(f_.results,
                  [&](const std::string& name) { return !is_there(name, "analysis.results"); });
  }

  StudyFindings run() {
    for (const std::string& result : f_.results) {
      const Column& c = *table_.find(result);
      f_.scatter.push_back(scatter(f_.repeats, observed_.distinct(c)));
      f_.exceedance.push_back(observed_.exceedance_of(c));
      relate(c);
      for (const Input& input : plan_.inputs) add_swing(input, c);
    }
    add_thresholds();
    add_comparisons(plan_, table_, observed_, resampling_, f_);
    return std::move(f_);
  }

 private:
  /// Is there such a column of numbers? Where a row is done it has to be.
  [[nodiscard]] bool is_there(const std::string& name, std::string_view key) const {
    const Column* c = table_.find(name);
    const bool result = key == "analysis.results";
    if (c && c->is_number && (!result || c->role == Role::found)) return true;
    if (result && c && c->role == Role::input)
      throw InputError(fmt::format(
          "{}: {}: '{}' is an input of the study and no result{}.", plan_.file.string(), key, name,
          table_.find("found:" + name) ? fmt::format(". What was found is 'found:{}'", name) : ""));
    const std::vector<std::string>& states = table_.find("state")->text;
    if (std::find(states.begin(), states.end(), "done") == states.end()) return false;
    throw InputError(fmt::format(
        "{}: {}: the table has no column of numbers '{}'. Take one of its header, such as {}.",
        plan_.file.string(), key, name, fmt::join(some_results(), ", ")));
  }

  /// A few that are there.
  [[nodiscard]] std::vector<std::string> some_results() const {
    constexpr std::size_t kSome = 6;
    std::vector<std::string> names = usual_results(table_);
    for (const Column& c : table_.columns)
      if (names.size() < kSome && c.role == Role::found && c.is_number &&
          std::find(names.begin(), names.end(), c.name) == names.end())
        names.push_back(c.name);
    return names;
  }

  [[nodiscard]] bool is_cause(const Column& x, const Column& y) const {
    if (&x == &y || !x.is_number || !varies(x)) return false;
    if (x.role == Role::input) return observed_.feeds(x, y);
    // How long a record goes on, and in what steps, is no measure of the motion.
    if (x.name.starts_with("motion_"))
      return x.name != "motion_dt_s" && x.name != "motion_duration_s";
    const std::vector<std::string> all = depths(table_);
    return std::find(all.begin(), all.end(), x.name) != all.end() &&
           !y.name.starts_with("liquefaction_depth_");
  }

  /// Rows that share a shaking come and go together.
  [[nodiscard]] Resampling resampling(const std::vector<std::size_t>& places,
                                      const Column& y) const {
    Resampling how = resampling_;
    how.units = observed_.units(places, y);
    return how;
  }

  void relate(const Column& y) {
    for (const Column& x : table_.columns) {
      if (!is_cause(x, y)) continue;
      const Pairs p = observed_.pairs(x, y);
      const Resampling how = resampling(observed_.places(x, y), y);
      Relation r{x.name, y.name, spearman(p.x, p.y, how), {}, {}, fit_line(p.x, p.y, how)};
      if (const std::set<std::string> by = observed_.beside(x, y); !by.empty()) {
        std::vector<std::string> level;
        for (const std::size_t i : observed_.places(x, y))
          level.push_back(place_of(plan_.rows[observed_.row(i)], by));
        r.within = spearman_within(level, p.x, p.y, how);
        r.by = fmt::format("{}", fmt::join(by, ", "));
      }
      f_.relations.push_back(std::move(r));
    }
  }

  void add_swing(const Input& input, const Column& y) {
    const Column& x = *table_.find(input.name);
    if (!observed_.feeds(x, y)) return;
    Effect effect;
    if (input.unit) {
      const Pairs p = observed_.pairs(x, y);
      effect = effect_of_number(p.x, p.y, resampling(observed_.places(x, y), y));
    } else {
      const std::vector<double> all = observed_.means(y);
      const std::vector<std::size_t> places = observed_.places(x, y);
      std::vector<std::string> words;
      std::vector<double> result;
      for (const std::size_t i : places) {
        words.push_back(x.text[observed_.row(i)]);
        result.push_back(all[i]);
      }
      effect = effect_of_choice(words, result, resampling(places, y));
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
      std::vector<std::size_t> places;
    };
    const std::set<std::string> by = observed_.beside(x, y);
    const std::vector<double> all_x = observed_.means(x), all_y = observed_.means(y);
    std::map<std::string, Level> levels;
    for (const std::size_t i : observed_.places(x, y)) {
      const std::size_t row = observed_.row(i);
      Level& level =
          levels.try_emplace(place_of(plan_.rows[row], by), Level{row, {}, {}}).first->second;
      level.pairs.x.push_back(all_x[i]);
      level.pairs.y.push_back(all_y[i]);
      level.places.push_back(i);
    }
    std::erase_if(levels, [](const auto& l) { return l.second.pairs.x.size() < kFewestForRamp; });
    for (const auto& [where, level] : levels)
      f_.thresholds.push_back(
          {x.name, y.name, where.empty() ? "" : *by.begin(), where, level.row,
           fit_ramp(level.pairs.x, level.pairs.y, resampling(level.places, y))});
    if (!levels.empty()) return;
    const Pairs p = observed_.pairs(x, y);
    f_.thresholds.push_back(
        {x.name, y.name, "", "", 0, fit_ramp(p.x, p.y, resampling(observed_.places(x, y), y))});
  }

  const Plan& plan_;
  const Table& table_;
  Resampling resampling_;
  Observations observed_;
  StudyFindings f_;
};

}  // namespace

StudyFindings analyse(const Plan& plan, const Table& table, const std::atomic<bool>* stop) {
  return Analyst(plan, table, stop).run();
}

}  // namespace flowslide::study
