#include "study/numbers/sobol.hpp"
#include "study/plan/read_parts.hpp"
#include "study/plan/yaml_read.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace flowslide::study {
namespace {

/// Numbers of one distribution, all in the same unit.
class Numbers {
 public:
  explicit Numbers(const YamlNode& node) : node_(node) {}
  double need_value(std::string_view key) {
    return take(need(node_, key, "the distribution is not complete"));
  }
  void optional_value(std::string_view key, double& value) {
    if (const auto node = node_.find(key)) value = take(*node);
  }
  [[nodiscard]] std::string unit() const { return unit_.value_or(""); }

 private:
  double take(const YamlNode& node) {
    const Amount amount = read_amount(node);
    if (unit_ && *unit_ != amount.unit)
      throw node.error(fmt::format("'{}' is in another unit than '{}' before it. Use one.",
                                   node.scalar(), *unit_));
    unit_ = amount.unit;
    return amount.value;
  }
  const YamlNode& node_;
  std::optional<std::string> unit_;
};

void read_distribution(SampledInput& input, const std::string& shape, const YamlNode& node) {
  Distribution& d = input.distribution;
  Numbers numbers(node);
  if (shape == "uniform" || shape == "triangular") {
    d.shape = shape == "uniform" ? Shape::uniform : Shape::triangular;
    allow_keys(node, d.shape == Shape::uniform ? std::vector<std::string>{"from", "to"}
                                               : std::vector<std::string>{"from", "mode", "to"});
    d.from = numbers.need_value("from");
    if (d.shape == Shape::triangular) d.mode = numbers.need_value("mode");
    d.to = numbers.need_value("to");
  } else {
    d.shape = shape == "normal" ? Shape::normal : Shape::lognormal;
    allow_keys(node, {"mean", "deviation", "min", "max"});
    d.mean = numbers.need_value("mean");
    d.deviation = numbers.need_value("deviation");
    numbers.optional_value("min", d.min);
    numbers.optional_value("max", d.max);
  }
  input.unit = numbers.unit();
  try {
    check(d);
  } catch (const InputError& e) {
    throw node.error(e.what());
  }
}

SampledInput read_input(const std::string& name, const YamlNode& node) {
  const std::vector<std::string> shapes{"uniform", "triangular", "normal", "lognormal"};
  allow_keys(node, {"setting", "uniform", "triangular", "normal", "lognormal"});
  SampledInput input{
      .name = name, .place = place_of(node), .settings = {}, .unit = {}, .distribution = {}};
  input.settings = read_settings_paths(need(node, "setting", "which setting is it?"));
  std::size_t found = 0;
  for (const std::string& shape : shapes)
    if (const auto numbers = node.find(shape)) {
      read_distribution(input, shape, *numbers);
      ++found;
    }
  if (found != 1)
    throw node.error(fmt::format("has {} distributions (one is needed). Give one of {}.", found,
                                 fmt::join(shapes, ", ")));
  return input;
}

std::size_t index_of(const Sample& sample, const YamlNode& node) {
  for (std::size_t i = 0; i < sample.inputs.size(); ++i)
    if (sample.inputs[i].name == node.scalar()) return i;
  throw node.error(
      fmt::format("there is no sampled input '{}'. Name one of 'inputs'.", node.scalar()));
}

void read_correlations(Sample& sample, const YamlNode& node) {
  if (node.kind() != YamlNode::Kind::list)
    throw node.error("is no list. Write [[one input, another input, coefficient]].");
  for (std::size_t i = 0; i < node.size(); ++i) {
    const YamlNode row = node.item(i);
    if (row.size() != 3)
      throw row.error("is no correlation. Write [one input, another input, coefficient].");
    const Correlated pair{index_of(sample, row.item(0)), index_of(sample, row.item(1)),
                          read_number(row.item(2))};
    if (pair.a == pair.b) throw row.error("correlates an input with itself. Name two.");
    for (const Correlated& p : sample.correlations)
      if (std::minmax(p.a, p.b) == std::minmax(pair.a, pair.b))
        throw row.error("correlates two inputs that are correlated above. Take one away.");
    sample.correlations.push_back(pair);
  }
  try {
    (void)correlation_factor(sample.inputs.size(), sample.correlations);
  } catch (const InputError& e) {
    throw node.error(e.what());
  }
}

}  // namespace

Sample read_sample(const YamlNode& node) {
  allow_keys(node, {"method", "count", "seed", "inputs", "correlations"});
  Sample sample;
  if (const auto method = node.find("method")) {
    const auto at = std::find(kSamplings.begin(), kSamplings.end(), method->scalar());
    if (at == kSamplings.end())
      throw method->error(fmt::format("'{}' is no way of sampling. Take one of {}.",
                                      method->scalar(), fmt::join(kSamplings, ", ")));
    sample.method = static_cast<Sampling>(at - kSamplings.begin());
  }
  sample.count = read_count(need(node, "count", "how many rows?"), 1, 100000);
  if (const auto seed = node.find("seed"))
    sample.seed = read_count(*seed, 0, static_cast<std::size_t>(1) << 62u);
  for (const auto& [name, input] : need(node, "inputs", "what is sampled?").entries())
    sample.inputs.push_back(read_input(name, input));
  if (sample.inputs.empty())
    throw node.find("inputs")->error("is empty (nothing is sampled). Name an input.");
  if (sample.method == Sampling::sobol && sample.inputs.size() > kSobolInputs)
    throw node.find("method")->error(fmt::format(
        "sobol takes {} inputs at most, and there are {} (its numbers are kept for so "
        "many). Take 'method: latin_hypercube', which has no such limit, or vary fewer.",
        kSobolInputs, sample.inputs.size()));
  if (const auto pairs = node.find("correlations")) read_correlations(sample, *pairs);
  return sample;
}

}  // namespace flowslide::study
