#include "cli/command.hpp"
#include "cli/terminal.hpp"
#include "cli/usage.hpp"
#include "core/units.hpp"
#include "motion/table.hpp"

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

namespace flowslide::cli {
namespace {

struct MotionOptions {
  std::vector<std::string> files;
  std::string pga, dt;  ///< with their units; empty: not given
  RecordFormat format;
  bool json = false;
};

/// The value of an option with its unit; nothing if it was not given.
std::optional<double> quantity(const char* option, const std::string& text, Dim dim) {
  if (text.empty()) return std::nullopt;
  try {
    return parse_quantity(text, dim);
  } catch (const InputError& e) {
    throw InputError(fmt::format("{}: {}", option, e.what()));
  }
}

int measure_records(MotionOptions options) {
  const std::optional<double> pga = quantity("--pga", options.pga, Dim::acceleration);
  if (const auto dt = quantity("--dt", options.dt, Dim::time)) options.format.dt = *dt;
  if (options.format.unit) unit_factor(*options.format.unit, Dim::acceleration);
  std::vector<MotionRow> rows;
  for (const std::string& file : options.files) {
    rows.push_back(measure_record(file, pga, options.format));
    for (const std::string& note : rows.back().notes) print_wrapped(stderr, "note: ", note);
    for (const std::string& warning : rows.back().warnings) print_warning(warning);
  }
  if (options.json)
    fmt::print("{}\n", motion_json(rows));
  else
    fmt::print("{}", motion_table(rows, pga));
  return 0;
}

}  // namespace

void add_motion(CLI::App& app, Command& action) {
  auto options = std::make_shared<MotionOptions>();
  CLI::App* command = app.add_subcommand("motion", "Measure earthquake records");
  command->add_option("files", options->files, "AT2, or columns of text or CSV; plain or gzip")
      ->required()
      ->check(input_name());
  command->add_option("--pga", options->pga, "scale to this peak, such as 0.3g, for PGV and MASI");
  command->add_option("--unit", options->format.unit,
                      "acceleration unit of files that do not state it: g, cm/s2, m/s2");
  command->add_option("--dt", options->dt, "time step, such as 0.01s, of files of one column");
  command->add_option("--time-column", options->format.time_column, "from 1, in wider files")
      ->check(CLI::NonNegativeNumber);
  command
      ->add_option("--acceleration-column", options->format.acceleration_column,
                   "from 1, in wider files")
      ->check(CLI::NonNegativeNumber);
  command->add_flag("--accept-count", options->format.accept_count,
                    "use AT2 files whose number of values is not their NPTS");
  command->add_flag("--json", options->json, "as JSON");
  command->callback(
      [options, &action] { action = [options] { return measure_records(*options); }; });
}

}  // namespace flowslide::cli
