#include "core/elementary.hpp"
#include "study/plan/read_parts.hpp"
#include "study/plan/yaml_read.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace flowslide::study {
namespace {

constexpr std::size_t kMostValues = 10000;

/// Makes the unit of a variable known if all its labels are numbers with the same one.
void find_unit(Variable& variable) {
  for (const Choice& choice : variable.choices) {
    const auto amount = parse_amount(choice.label);
    if (!amount || (variable.unit && *variable.unit != amount->unit)) {
      variable.unit.reset();
      return;
    }
    variable.unit = amount->unit;
  }
}

std::vector<std::string> range(const YamlNode& node) {
  allow_keys(node, {"from", "to", "step", "count", "spacing"});
  const Amount from = read_amount(need(node, "from", "a range begins somewhere"));
  const Amount to = read_amount(need(node, "to", "a range ends somewhere"));
  const auto step = node.find("step"), count = node.find("count"), spacing = node.find("spacing");
  if (from.unit != to.unit)
    throw node.error(
        fmt::format("goes from '{}' to '{}' (two units). Write both in one.", from.unit, to.unit));
  if (step.has_value() == count.has_value())
    throw node.error("needs either 'step' or 'count' (how many values there are).");
  const bool log = spacing && spacing->scalar() == "log";
  if (spacing && !log && spacing->scalar() != "linear")
    throw spacing->error(fmt::format("'{}' is no spacing. Take linear or log.", spacing->scalar()));
  if (log && (step || !(from.value > 0.0) || !(to.value > 0.0)))
    throw node.error("spacing log needs 'count' and ends above 0 (equal ratios).");
  std::vector<std::string> texts;
  if (step) {
    const Amount by = read_amount(*step);
    const double steps = (to.value - from.value) / by.value;
    if (by.unit != from.unit || !(steps >= 0.0) || !(steps < kMostValues))
      throw step->error(fmt::format("'{}' does not lead from {} to {}. Mend unit, sign or size.",
                                    step->scalar(), to_text(from), to_text(to)));
    if (std::abs(steps - std::round(steps)) > 1e-6)
      throw step->error(fmt::format(
          "'{}' leads from {} to {} and past {} (the range would end before it). Choose another "
          "step or end.",
          step->scalar(), to_text(from),
          to_text({from.value + std::floor(steps) * by.value, from.unit}), to_text(to)));
    for (std::size_t i = 0; static_cast<double>(i) <= steps + 1e-6; ++i)
      texts.push_back(to_text({from.value + static_cast<double>(i) * by.value, from.unit}));
    return texts;
  }
  const std::size_t n = read_count(*count, 2, kMostValues);
  for (std::size_t i = 0; i < n; ++i) {
    const double share = static_cast<double>(i) / static_cast<double>(n - 1);
    const double value = log ? flowslide::exp(flowslide::log(from.value) * (1.0 - share) +
                                              flowslide::log(to.value) * share)
                             : from.value * (1.0 - share) + to.value * share;
    texts.push_back(to_text({value, from.unit}));
  }
  return texts;
}

/// `setting` with `values` or `range`.
void read_values(Variable& variable, const YamlNode& node) {
  allow_keys(node, {"setting", "values", "range", "labels"});
  variable.settings = read_settings_paths(need(node, "setting", "which setting is it?"));
  const auto values = node.find("values"), span = node.find("range"), labels = node.find("labels");
  if (values.has_value() == span.has_value())
    throw node.error("needs either 'values' or 'range' (what the setting becomes).");
  std::vector<std::string> texts, names;
  if (span) {
    texts = names = range(*span);
  } else {
    if (values->kind() != YamlNode::Kind::list || values->size() == 0)
      throw values->error("is no list (one row per value). Write [a, b].");
    for (std::size_t i = 0; i < values->size(); ++i) {
      texts.push_back(flow_text(values->item(i)));
      names.push_back(values->item(i).kind() == YamlNode::Kind::scalar ? values->item(i).scalar()
                                                                       : texts.back());
    }
  }
  if (labels) names = read_texts(*labels);
  if (names.size() != texts.size())
    throw labels->error(
        fmt::format("{} labels for {} values. Give one for each.", names.size(), texts.size()));
  for (std::size_t i = 0; i < texts.size(); ++i) {
    Choice& choice = variable.choices.emplace_back(Choice{names[i], {}, {}});
    for (const std::string& path : variable.settings) choice.set.emplace_back(path, texts[i]);
  }
}

void read_zip(Variable& variable, const YamlNode& node) {
  allow_keys(node, {"zip", "labels"});
  const YamlNode zip = *node.find("zip");
  for (const auto& [path, values] : zip.entries()) {
    expect_path(values, path);
    if (values.kind() != YamlNode::Kind::list || values.size() == 0)
      throw values.error("is no list (lists are zipped item by item). Write [a, b].");
    if (variable.settings.empty()) variable.choices.resize(values.size());
    if (values.size() != variable.choices.size())
      throw values.error(
          fmt::format("{} values beside a list of {} (they are zipped item by item)."
                      " Make them equally long.",
                      values.size(), variable.choices.size()));
    for (std::size_t i = 0; i < values.size(); ++i) {
      Choice& choice = variable.choices[i];
      choice.set.emplace_back(path, flow_text(values.item(i)));
      if (variable.settings.empty()) choice.label = read_texts(values.item(i)).front();
    }
    variable.settings.push_back(path);
  }
  if (variable.settings.empty()) throw zip.error("is empty (nothing is zipped). Name settings.");
  if (const auto labels = node.find("labels")) {
    const std::vector<std::string> names = read_texts(*labels);
    if (names.size() != variable.choices.size())
      throw labels->error(fmt::format("{} labels for {} values. Give one for each.", names.size(),
                                      variable.choices.size()));
    for (std::size_t i = 0; i < names.size(); ++i) variable.choices[i].label = names[i];
  }
}

/// Are two labels one text, or one number in one unit?
bool same(const std::string& a, const std::string& b) {
  if (a == b) return true;
  const auto x = parse_amount(a), y = parse_amount(b);
  return x && y && x->value == y->value && x->unit == y->unit;
}

}  // namespace

std::string place_of(const YamlNode& node) { return node.key_where().text(); }

void read_set(const YamlNode& node, Part& part) {
  for (const auto& [path, value] : node.entries()) {
    expect_path(value, path);
    part.set.emplace_back(path, flow_text(value));
    part.places.push_back(place_of(value));
  }
}

std::vector<Variable> read_vary(const YamlNode& node) {
  std::vector<Variable> variables;
  for (const auto& [name, value] : node.entries()) {
    Variable variable{
        .name = name, .place = place_of(value), .settings = {}, .unit = {}, .choices = {}};
    if (value.find("zip"))
      read_zip(variable, value);
    else if (value.find("table"))
      read_table(variable, value);
    else
      read_values(variable, value);
    find_unit(variable);
    for (std::size_t i = 0; i < variable.choices.size(); ++i)
      for (std::size_t j = 0; j < i; ++j)
        if (same(variable.choices[i].label, variable.choices[j].label))
          throw value.error(
              fmt::format("'{}' stands there twice{} (two rows could not be told "
                          "apart). Take one away, or give labels.",
                          variable.choices[j].label,
                          variable.choices[i].label == variable.choices[j].label
                              ? ""
                              : fmt::format(", also as '{}'", variable.choices[i].label)));
    variables.push_back(std::move(variable));
  }
  return variables;
}

}  // namespace flowslide::study
