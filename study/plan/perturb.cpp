#include "study/plan/perturb.hpp"

#include "core/units.hpp"
#include "study/plan/yaml_read.hpp"

#include <algorithm>
#include <cmath>

namespace flowslide::study {
namespace {

/// All digits: a step of 1e-6 must not be rounded away.
std::string exact_text(const Amount& amount) {
  const std::string number = fmt::format("{:.15g}", amount.value);
  return amount.unit.empty() ? number : number + " " + amount.unit;
}

std::optional<YamlNode> find_path(YamlNode node, std::string_view path) {
  while (!path.empty()) {
    if (node.kind() != YamlNode::Kind::map) return std::nullopt;
    const std::string_view key = path.substr(0, path.find('.'));
    const auto child = node.find(key);
    if (!child) return std::nullopt;
    node = *child;
    path.remove_prefix(std::min(key.size() + 1, path.size()));
  }
  return node;
}

void scale(Settings& set, const YamlNode& node, const std::string& path, double change) {
  Amount amount = read_amount(node);
  const std::string before = exact_text(amount);
  amount.value *= 1.0 + change;
  set.emplace_back(path, exact_text(amount));
  if (set.back().second == before)
    throw node.error(fmt::format(
        "{} is the same number after a change by the share of {:g} (a repeat would show a scatter "
        "of zero). Give the repeat a larger step, or another setting.",
        before, change));
}

struct Stage {
  std::string name, uses;
  std::optional<YamlNode> with;
};

std::vector<Stage> stages_of(const YamlNode& workflow) {
  std::vector<Stage> stages;
  const auto list = workflow.find("stages");
  if (!list) return stages;
  for (const auto& [name, node] : list->entries())
    if (const auto uses = node.find("uses"))
      stages.push_back({name, uses->scalar(), node.find("with")});
  return stages;
}

void scale_motions(Settings& set, const std::vector<Stage>& stages, double change) {
  for (const Stage& stage : stages) {
    if (stage.uses != "motion.prepare" || !stage.with) continue;
    const std::string path = fmt::format("stages.{}.with.", stage.name);
    bool found = false;
    for (const char* key : {"pga", "synthetic.pga"})
      if (const auto node = find_path(*stage.with, key); node && !found) {
        scale(set, *node, path + key, change);
        found = true;
      }
    if (!found)
      throw stage.with->error("has no 'pga' (a repeat scales it by a millionth). Give one.");
  }
}

void move_grids(Settings& set, const std::vector<Stage>& stages, std::size_t realisation) {
  double cell = kUnset;
  for (const Stage& stage : stages)
    if (stage.uses == "mpm.run" && stage.with)
      if (const auto node = stage.with->find("cell"))
        cell = parse_quantity(node->scalar(), Dim::length);
  if (!is_set(cell)) return;
  const std::array<double, 2> share = shift_of(realisation);
  for (const Stage& stage : stages) {
    if (stage.uses != "mpm.run" && stage.uses != "transfer.map") continue;
    std::array<double, 2> origin{};
    if (const auto node = stage.with ? stage.with->find("grid_origin") : std::nullopt)
      for (std::size_t d = 0; d < 2 && d < node->size(); ++d)
        origin[d] = parse_quantity(node->item(d).scalar(), Dim::length);
    set.emplace_back(fmt::format("stages.{}.with.grid_origin", stage.name),
                     fmt::format("[{:.12g} m, {:.12g} m]", origin[0] + share[0] * cell,
                                 origin[1] + share[1] * cell));
  }
}

}  // namespace

double change_of(std::size_t realisation, double step) {
  const std::size_t steps = (realisation + 1) / 2;
  const double size = static_cast<double>(steps) * step;
  return realisation % 2 == 1 ? size : -size;
}

std::array<double, 2> shift_of(std::size_t realisation) {
  // 1/g and 1/g^2 with g^3 = g + 1
  constexpr std::array<double, 2> kStep{0.7548776662466927, 0.5698402909980532};
  std::array<double, 2> shift{};
  for (std::size_t d = 0; d < 2; ++d) {
    const double x = static_cast<double>(realisation) * kStep[d];
    shift[d] = x - std::floor(x);
  }
  return shift;
}

Settings perturbations(const YamlNode& workflow, const Repeat& repeat, std::size_t realisation) {
  Settings set;
  if (realisation == 0) return set;
  const std::vector<Stage> stages = stages_of(workflow);
  if (repeat.motion > 0.0) scale_motions(set, stages, change_of(realisation, repeat.motion));
  if (repeat.grid) move_grids(set, stages, realisation);
  for (const auto& [path, step] : repeat.scale) {
    const auto node = find_path(workflow, path);
    if (!node)
      throw InputError(
          fmt::format("{}: {} is not written in the workflow (a repeat scales what is "
                      "there). Add it under 'set'.",
                      repeat.place, path));
    if (std::any_of(set.begin(), set.end(),
                    [&, &path = path](const auto& s) { return s.first == path; }))
      throw InputError(
          fmt::format("{}: {} is disturbed twice, by 'scale' and by 'motion' or 'grid' (only one "
                      "would act). Take one away.",
                      repeat.place, path));
    scale(set, *node, path, change_of(realisation, step));
  }
  if (set.empty())
    throw InputError(
        fmt::format("{}: nothing of the workflow can be disturbed (it has neither a "
                    "motion nor a grid). Name settings under 'scale'.",
                    repeat.place));
  return set;
}

}  // namespace flowslide::study
