#include "cli/command.hpp"
#include "cli/terminal.hpp"
#include "cli/usage.hpp"
#include "config/yaml.hpp"
#include "constitutive/point_config.hpp"
#include "core/files.hpp"
#include "workflows/engine/stage.hpp"

#include <memory>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

namespace flowslide::cli {
namespace {

struct PointOptions {
  std::string file, csv;
  std::vector<std::string> overrides;
};

int drive_point(const PointOptions& options) {
  refuse_same_file(options.file, options.csv);
  const YamlNode document = load_yaml(options.file, options.overrides);
  const auto config = read_settings<PointConfig>(document, "");
  const PointReport report = [&] {
    try {
      return run_point(config);
    } catch (const InputError& e) {
      throw detail::locate(document, e.what());
    } catch (const NumericsError& e) {
      throw NumericsError(fmt::format("{}: {}", options.file, e.what()));
    }
  }();
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
  command->callback([options, &action] { action = [options] { return drive_point(*options); }; });
}

}  // namespace flowslide::cli
