#include "study/plan/read_parts.hpp"
#include "study/plan/yaml_read.hpp"

namespace flowslide::study {
namespace {

constexpr std::size_t kMostRepeats = 1000;
constexpr double kUsualStep = 1e-6;

/// The last realisation is changed by count / 2 steps.
double read_step(const YamlNode& node, std::size_t count) {
  const double step = read_number(node);
  constexpr double kLargest = 1e-3;
  const std::size_t steps = count / 2;
  const double most = step * static_cast<double>(steps);
  if (step >= 0.0 && step <= kLargest && most > kLargest * (1.0 + 1e-9))
    throw node.error(fmt::format(
        "{:g} becomes {:g} in the last of {} realisations (a change from 0 to {:g} means nothing "
        "to the dam; a larger one is an input). Make it or their number smaller.",
        step, most, count, kLargest));
  if (!(step >= 0.0 && step <= kLargest))
    throw node.error(fmt::format(
        "{:g} is no disturbance (a change from 0 to {:g} means nothing to the dam; a larger one is "
        "an input). Make it smaller, or use 'vary'.",
        step, kLargest));
  return step;
}

double read_scale(const YamlNode& node, std::size_t count) {
  const double step = read_step(node, count);
  if (step == 0.0) throw node.error("is no step (nothing would be disturbed). Give one above 0.");
  return step;
}

}  // namespace

Repeat read_repeat(const YamlNode& node) {
  Repeat repeat{
      .place = place_of(node), .count = 1, .motion = 0.0, .grid = false, .scale = {}, .rows = {}};
  if (node.kind() == YamlNode::Kind::scalar) {
    repeat.count = read_count(node, 1, kMostRepeats);
    repeat.motion = kUsualStep;
    repeat.grid = true;
    return repeat;
  }
  allow_keys(node, {"count", "motion", "grid", "scale", "rows"});
  repeat.count = read_count(need(node, "count", "how many realisations?"), 1, kMostRepeats);
  const auto motion = node.find("motion"), grid = node.find("grid"), scale = node.find("scale");
  if (!motion && !grid && !scale) {
    repeat.motion = kUsualStep;
    repeat.grid = true;
  }
  if (motion) repeat.motion = read_step(*motion, repeat.count);
  if (grid) {
    if (grid->scalar() != "true" && grid->scalar() != "false")
      throw grid->error(fmt::format("'{}' is no switch. Write true or false.", grid->scalar()));
    repeat.grid = grid->scalar() == "true";
  }
  if (scale)
    for (const auto& [path, step] : scale->entries()) {
      expect_path(step, path);
      repeat.scale.emplace_back(path, read_scale(step, repeat.count));
    }
  if (const auto rows = node.find("rows"))
    for (const auto& [name, labels] : rows->entries()) repeat.rows[name] = read_texts(labels);
  return repeat;
}

}  // namespace flowslide::study
