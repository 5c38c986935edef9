#include "study/table/observations.hpp"

#include <algorithm>
#include <map>
#include <numeric>

#include <fmt/format.h>

namespace flowslide::study {
namespace {

/// Rows that differ in their repeat only have the same number.
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

}  // namespace

Observations::Observations(const Plan& plan, const Table& table)
    : plan_(plan), table_(table), repeats_(group_rows(groups_of(plan))) {
  std::map<std::string, std::size_t> count;
  for (const auto& rows : repeats_.groups) ++count[plan.rows[rows[0]].variant];
  for (const auto& rows : repeats_.groups) {
    const std::string& name = plan.rows[rows[0]].variant;
    if (variant_.empty() || count[name] > count[variant_]) variant_ = name;
  }
  for (std::size_t g = 0; g < repeats_.groups.size(); ++g)
    if (plan.rows[repeats_.groups[g][0]].variant == variant_) groups_.push_back(g);
}

std::vector<double> Observations::distinct(const Column& c) const {
  std::vector<double> result = c.number;
  if (c.node.empty()) return result;
  for (const auto& rows : repeats_.groups) {
    std::set<std::size_t> seen;
    for (const std::size_t row : rows)
      if (is_set(result[row]) && !seen.insert(c.node[row]).second) result[row] = kUnset;
  }
  return result;
}

std::vector<double> Observations::means(const Column& c) const {
  const std::vector<double> values = distinct(c);
  std::vector<double> result;
  for (const std::size_t g : groups_) {
    std::vector<double> here;
    for (const std::size_t row : repeats_.groups[g])
      if (is_set(values[row])) here.push_back(values[row]);
    result.push_back(mean(here));
  }
  return result;
}

Exceedance Observations::exceedance_of(const Column& c) const {
  // groups whose first rows share a stage are one observation, with all repeats of it
  const std::vector<double> values = distinct(c);
  std::map<std::size_t, std::map<std::size_t, double>> observed;
  std::size_t other = kNoNode;
  for (const std::size_t g : groups_) {
    const std::vector<std::size_t>& rows = repeats_.groups[g];
    const std::size_t first = c.node.empty() ? kNoNode : c.node[rows[0]];
    auto& here = observed[first == kNoNode ? --other : first];
    for (const std::size_t row : rows)
      if (is_set(values[row])) here.emplace(c.node.empty() ? row : c.node[row], values[row]);
  }
  std::vector<Weighted> weighted;
  for (const auto& [first, here] : observed)
    for (const auto& [node, v] : here)
      weighted.push_back({v, 1.0 / static_cast<double>(here.size())});
  return exceedance(std::move(weighted));
}

std::vector<std::size_t> Observations::places(const Column& x, const Column& y) const {
  const std::vector<double> all_x = means(x), all_y = means(y), values = distinct(y);
  std::map<std::pair<std::string, std::size_t>, std::size_t> best;
  std::vector<std::size_t> found, repeated(groups_.size());
  for (std::size_t i = 0; i < groups_.size(); ++i) {
    if (!is_set(all_y[i]) || (x.is_number && !is_set(all_x[i]))) continue;
    const std::vector<std::size_t>& rows = repeats_.groups[groups_[i]];
    for (const std::size_t r : rows) repeated[i] += is_set(values[r]);
    const std::size_t node = y.node.empty() ? kNoNode : y.node[row(i)];
    // of x that of the first row: repeats move it by what means nothing
    const auto [it, is_new] =
        node == kNoNode ? std::pair{best.end(), true} : best.try_emplace({x.text[row(i)], node}, i);
    if (is_new) {
      found.push_back(i);
    } else if (repeated[i] > repeated[it->second]) {
      *std::find(found.begin(), found.end(), it->second) = i;
      it->second = i;
    }
  }
  std::sort(found.begin(), found.end());
  return found;
}

std::vector<std::size_t> Observations::units(const std::vector<std::size_t>& groups,
                                             const Column& y) const {
  std::vector<std::size_t> found;
  for (const std::size_t i : groups) found.push_back(y.node.empty() ? kNoNode : y.node[row(i)]);
  const std::set<std::size_t> nodes(found.begin(), found.end());
  if (y.node.empty() || nodes.contains(kNoNode)) {
    std::iota(found.begin(), found.end(), std::size_t{0});
    return found;
  }
  std::map<std::string, std::vector<std::size_t>> stages;
  for (const std::size_t n : found)
    for (const std::size_t before : plan_.nodes[n].before)
      stages[plan_.nodes[before].stage.name].push_back(before);
  std::size_t finest = 1;
  for (const auto& [name, shared] : stages) {
    const std::size_t kinds = std::set<std::size_t>(shared.begin(), shared.end()).size();
    if (shared.size() != groups.size() || kinds <= finest || kinds >= nodes.size()) continue;
    finest = kinds;
    found = shared;
  }
  return found;
}

Pairs Observations::pairs(const Column& x, const Column& y) const {
  const std::vector<double> all_x = means(x), all_y = means(y);
  Pairs pairs;
  for (const std::size_t i : places(x, y)) {
    pairs.x.push_back(all_x[i]);
    pairs.y.push_back(all_y[i]);
  }
  return pairs;
}

bool Observations::feeds(const Column& x, const Column& y) const {
  const auto n =
      std::find_if(y.node.begin(), y.node.end(), [](std::size_t node) { return node != kNoNode; });
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

std::set<std::string> Observations::beside(const Column& x, const Column& y) const {
  constexpr std::size_t kMost = 6;
  std::set<std::string> names;
  for (const Input& input : plan_.inputs) {
    const Column& c = *table_.find(input.name);
    std::set<std::string> values;
    for (std::size_t i = 0; i < groups_.size(); ++i) values.insert(c.text[row(i)]);
    const bool moves_x = x.role == Role::input ? &c == &x : feeds(c, x);
    if (values.size() > 1 && values.size() <= kMost && !moves_x && feeds(c, y))
      names.insert(input.name);
  }
  return names;
}

std::string place_of(const Row& row, const std::set<std::string>& names) {
  std::string where;
  for (const auto& [name, value] : row.values) {
    if (!names.contains(name)) continue;
    const auto amount = parse_amount(value);
    where +=
        fmt::format("{}{} {}", where.empty() ? "" : ", ", name, amount ? to_text(*amount) : value);
  }
  return where;
}

}  // namespace flowslide::study
