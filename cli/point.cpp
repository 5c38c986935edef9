#include "cli/command.hpp"
#include "cli/terminal.hpp"
#include "cli/usage.hpp"
#include "config/yaml.hpp"
#include "constitutive/point_config.hpp"
#include "constitutive/point_fit.hpp"
#include "core/check.hpp"
#include "core/files.hpp"
#include "core/units.hpp"
#include "workflows/engine/stage.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

namespace flowslide::cli {
namespace {

struct PointOptions {
  std::string file, csv;
  std::vector<std::string> overrides;
  std::string find;  ///< path of the parameter
  CyclicTarget target;
};

PointReport drive(const YamlNode& document, const PointConfig& config, const std::string& file) {
  try {
    return run_point(config);
  } catch (const InputError& e) {
    throw detail::locate(document, e.what());
  } catch (const NumericsError& e) {
    throw NumericsError(fmt::format("{}: {}", file, e.what()));
  }
}

/// The plain number above zero that stands at a path.
double number_at(const YamlNode& document, const std::string& path) {
  std::optional<YamlNode> node = document;
  for (std::string_view rest = path; node && !rest.empty();) {
    const std::size_t dot = std::min(rest.find('.'), rest.size());
    node = node->kind() == YamlNode::Kind::map ? node->find(rest.substr(0, dot)) : std::nullopt;
    rest.remove_prefix(std::min(dot + 1, rest.size()));
  }
  double value = 0.0;
  std::size_t length = 0;
  validate(
      node && node->kind() == YamlNode::Kind::scalar &&
          parse_number(node->scalar(), value, length) && length == node->scalar().size() &&
          value > 0.0,
      "--find {}: no plain number above zero stands there (it is where the search begins) name "
      "a parameter of the law as it stands in the file, such as material.pm4sand.hpo, and give "
      "it a value that is about right",
      path);
  return value;
}

int cycles_needed(const CyclicTarget& target) {
  return static_cast<int>(std::ceil(target.cycles)) + 1;
}

/// Finds the parameter, tells it and puts it among the overrides.
void find_parameter(PointOptions& options) {
  const YamlNode document = load_yaml(options.file, options.overrides);
  const CyclicTarget& target = options.target;
  validate(
      target.cycles >= 0.5 && target.cycles <= 1e4 && target.strain > 0.0 && target.strain <= 0.5,
      "--cycles {:g} --strain {:g}: cycles from 0.5 to 10000 and a shear strain up to 0.5 are "
      "meant, such as --cycles 15 --strain 0.03",
      target.cycles, target.strain);
  {
    const auto config = read_settings<PointConfig>(document, "");
    validate(
        config.simple_shear && (config.simple_shear->csr || config.simple_shear->reversal_stress),
        "--find needs a test that turns at a shear stress (cycles are counted in it) give "
        "simple_shear.csr");
  }
  const double start = number_at(document, options.find);
  const PointFit found = fit_to_cycles(start, target.cycles, [&](double value) {
    std::vector<std::string> overrides = options.overrides;
    overrides.push_back(fmt::format("{}={:.17g}", options.find, value));
    const YamlNode trial = load_yaml(options.file, overrides);
    auto config = read_settings<PointConfig>(trial, "");
    config.simple_shear->stop_strain = target.strain;
    config.simple_shear->max_cycles = cycles_needed(target);
    return cycles_to_strain(drive(trial, config, options.file).rows, target.strain)
        .value_or(std::numeric_limits<double>::infinity());
  });
  const std::string value = fmt::format("{:.4g}", found.value);
  const std::string strain = fmt::format("{:g} % of shear strain", 100.0 * target.strain);
  const std::string after = std::isfinite(found.cycles)
                                ? fmt::format("{} after {:g} cycles", strain, found.cycles)
                                : "no " + strain;
  print_row(stdout, fmt::format("{:<32} ", options.find),
            fmt::format("{}: {} ({} tests)", value, after, found.tests));
  if (found.cycles > target.cycles + 0.5)
    print_warning(
        fmt::format("{}: with {} there is {}, with a value a thousandth beside it less "
                    "than {:g}: the strength jumps, and no value gives what was asked for.",
                    options.find, value, after, target.cycles));
  options.overrides.push_back(options.find + "=" + value);
}

int drive_point(PointOptions options) {
  refuse_same_file(options.file, options.csv);
  if (!options.find.empty()) find_parameter(options);
  const YamlNode document = load_yaml(options.file, options.overrides);
  auto config = read_settings<PointConfig>(document, "");
  if (!options.find.empty()) {  // far enough to show what was found
    PointShear& shear = *config.simple_shear;
    shear.stop_strain = std::max(shear.stop_strain, options.target.strain);
    shear.max_cycles = std::max(shear.max_cycles, cycles_needed(options.target));
  }
  const PointReport report = drive(document, config, options.file);
  for (const std::string& warning : report.warnings) print_warning(warning);
  for (const auto& [name, text] : report.facts)
    print_row(stdout, fmt::format("{:<32} ", name), text);
  if (!options.csv.empty()) {
    write_file(options.csv, point_csv(report));
    fmt::print("{:<32} {}\n", "written", options.csv);
  }
  return 0;
}

}  // namespace

void add_point(CLI::App& app, Command& action) {
  auto options = std::make_shared<PointOptions>();
  CLI::App* command = app.add_subcommand("point", "Drive one material point along a path");
  command->add_option("file", options->file, "material, stress and path, YAML")
      ->required()
      ->check(input_name());
  command->add_option("--csv", options->csv, "write every step to this file")->check(output_name());
  command->add_option("--set", options->overrides, "override a setting, PATH=VALUE")
      ->take_all()
      ->allow_extra_args(false);
  CLI::Option* find = command->add_option(
      "--find", options->find, "find this parameter for a cyclic strength: material.pm4sand.hpo");
  CLI::Option* cycles = command->add_option("--cycles", options->target.cycles,
                                            "cycles of --find until the shear strain is reached");
  find->needs(cycles);
  cycles->needs(find);
  command->add_option("--strain", options->target.strain, "that shear strain [0.03]")->needs(find);
  command->callback([options, &action] { action = [options] { return drive_point(*options); }; });
}

}  // namespace flowslide::cli
