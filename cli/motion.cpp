#include "cli/command.hpp"
#include "cli/terminal.hpp"
#include "cli/usage.hpp"
#include "core/check.hpp"
#include "core/units.hpp"
#include "motion/foreign.hpp"
#include "motion/table.hpp"

#include <memory>
#include <optional>
#include <string>
#include <unistd.h>
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

constexpr int kMostColumns = 10000;
constexpr double kHighestPeak = 1e3;  ///< [m/s2]

/// As a table, or one under the other where the table is wider than the terminal.
void print_measures(const std::vector<MotionRow>& rows, std::optional<double> pga) {
  const std::string table = motion_table(rows, pga);
  const bool fits =
      ::isatty(STDOUT_FILENO) != 1 || table.find('\n') <= terminal_columns(STDOUT_FILENO);
  fmt::print("{}", fits ? table : motion_list(rows, pga));
}

int measure_records(MotionOptions options) {
  const std::optional<double> pga = quantity("--pga", options.pga, Dim::acceleration);
  validate(!pga || (*pga > 0.0 && *pga <= kHighestPeak),
           "--pga: '{}' is no peak of an earthquake (more than 0 and at most {:g} m/s2 are)",
           options.pga, kHighestPeak);
  if (const auto dt = quantity("--dt", options.dt, Dim::time)) options.format.dt = *dt;
  check_unit(options.format.unit);
  std::vector<MotionRow> rows;
  if (pga)
    for (const std::string& odd : implausible("--pga", *pga, kUnset)) print_warning(odd);
  for (const std::string& file : options.files) {
    rows.push_back(measure_record(file, pga, options.format));
    for (const std::string& note : rows.back().notes) print_wrapped(stderr, "note: ", note);
    for (const std::string& warning : rows.back().warnings) print_warning(warning);
  }
  if (options.json)
    fmt::print("{}\n", motion_json(rows));
  else
    print_measures(rows, pga);
  return 0;
}

}  // namespace

void add_motion(CLI::App& app, Command& action) {
  auto options = std::make_shared<MotionOptions>();
  CLI::App* command = app.add_subcommand("motion", "Measure earthquake records");
  command->add_option("files", options->files, "AT2, or columns of text or CSV; plain or gzip")
      ->required()
      ->check(input_name());
  command->add_option("--pga", options->pga, "scale to this peak, such as 0.3g, for PGV and MASI")
      ->check(some_value());
  command
      ->add_option("--unit", options->format.unit,
                   "acceleration unit of files that do not state it: g, cm/s2, m/s2")
      ->check(some_value());
  command->add_option("--dt", options->dt, "time step, such as 0.01s, of files of one column")
      ->check(some_value());
  command->add_option("--time-column", options->format.time_column, "from 1, in wider files")
      ->check(CLI::Range(0, kMostColumns));
  command
      ->add_option("--acceleration-column", options->format.acceleration_column,
                   "from 1, in wider files")
      ->check(CLI::Range(0, kMostColumns));
  command->add_flag("--accept-count", options->format.accept_count,
                    "use AT2 files whose number of values is not their NPTS");
  command->add_flag("--json", options->json, "as JSON");
  command->callback(
      [options, &action] { action = [options] { return measure_records(*options); }; });
}

}  // namespace flowslide::cli
