#include "study/plan/check_results.hpp"

#include "core/nearest.hpp"
#include "workflows/stages/numbers_given.hpp"

#include <algorithm>
#include <set>

#include <fmt/format.h>

namespace flowslide::study {
namespace {

/// Is `name` one of those that `pattern` stands for? Its '*' is one name, which may have dots.
bool matches(std::string_view name, std::string_view pattern) {
  const std::size_t star = pattern.find('*');
  if (star == std::string_view::npos) return name == pattern;
  const std::string_view before = pattern.substr(0, star), after = pattern.substr(star + 1);
  return name.size() > before.size() + after.size() && name.starts_with(before) &&
         name.ends_with(after);
}

/// What the stages of all rows give; nothing if that is not known of one of them.
std::vector<std::string> given(const Plan& plan) {
  std::set<std::string> all;
  for (const Node& node : plan.nodes) {
    const auto names = numbers_given(node.stage.type.name, node.stage.prepared.settings);
    if (names.empty()) return {};
    all.insert(names.begin(), names.end());
  }
  return {all.begin(), all.end()};
}

bool is_input(const Plan& plan, const std::string& name) {
  return std::any_of(plan.inputs.begin(), plan.inputs.end(),
                     [&](const Input& input) { return input.name == name; });
}

/// The nearest name, or some.
std::string advice(const std::string& name, const std::vector<std::string>& known) {
  if (const auto near = nearest(name, known)) return fmt::format("Did you mean '{}'?", *near);
  std::vector<std::string> some;
  for (const std::string usual : {"runout_m", "volume_past_toe_m3_per_m", "motion_pga_m_s2"})
    if (std::find(known.begin(), known.end(), usual) != known.end()) some.push_back(usual);
  for (const std::string& depth : known)
    if (some.size() < 6 && depth.starts_with("liquefaction_depth_")) some.push_back(depth);
  return fmt::format("They give {} and others.", fmt::join(some.empty() ? known : some, ", "));
}

}  // namespace

void check_results(const StudyFile& study, const Plan& plan) {
  if (std::any_of(plan.rows.begin(), plan.rows.end(),
                  [](const Row& row) { return !row.problem.empty(); }))
    return;
  const std::vector<std::string> known = given(plan);
  if (known.empty()) return;
  const auto expect = [&](const std::string& column, std::string_view key, bool may_be_input) {
    const bool other = column.starts_with("found:");
    const std::string name = other ? column.substr(6) : column;
    const auto place = study.analysis.places.find(column);
    const std::string where =
        place == study.analysis.places.end() ? study.file.string() : place->second;
    const bool is_given = std::any_of(known.begin(), known.end(),
                                      [&](const std::string& p) { return matches(name, p); });
    if (!other && is_input(plan, name)) {
      if (may_be_input) return;
      throw InputError(fmt::format(
          "{}: {}: '{}' is an input of the study and no result. {}", where, key, name,
          is_given ? fmt::format("What the stages give is 'found:{}'.", name) : "Take it away."));
    }
    if (is_given) return;
    throw InputError(fmt::format(
        "{}: {}: no stage of the study gives a number '{}' (the table would not have it). {}",
        where, key, name, advice(name, known)));
  };
  for (const std::string& name : plan.analysis.results) expect(name, "analysis.results", false);
  for (const auto& [x, y] : plan.analysis.thresholds)
    for (const std::string& name : {x, y}) expect(name, "analysis.thresholds", true);
}

}  // namespace flowslide::study
