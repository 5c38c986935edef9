#include "cli/case_list.hpp"
#include "cli/command.hpp"
#include "cli/terminal.hpp"
#include "cli/usage.hpp"

#include <cstdio>
#include <memory>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

namespace flowslide::cli {
namespace {

struct BenchOptions {
  std::vector<std::string> names;
  bool json = false, list = false, large = false;
};

int bench(const BenchOptions& options) {
  const auto cases = select(all_benchmarks(), options.names, options.large || options.list);
  if (options.list) {
    for (const BenchCase& c : cases)
      print_row(stdout, fmt::format("{:<26} ", c.name),
                fmt::format("{}{}", c.doc, c.large ? " (large)" : ""));
    return 0;
  }
  if (!options.json) fmt::print("{}\n", measurement_heading());
  std::vector<Measurement> all;
  for (const BenchCase& c : cases) {
    for (Measurement& m : c.run()) {
      if (!options.json) fmt::print("{}\n", measurement_row(m));
      all.push_back(std::move(m));
    }
    std::fflush(stdout);
  }
  if (options.json) fmt::print("{}\n", measurements_json(all));
  return 0;
}

}  // namespace

void add_bench(CLI::App& app, Command& action) {
  auto options = std::make_shared<BenchOptions>();
  CLI::App* command = app.add_subcommand("bench", "Measure speed, and error against cost");
  command->add_option("names", options->names, "groups or benchmarks [all]")->check(input_name());
  command->add_flag("--json", options->json, "as JSON");
  command->add_flag("--large", options->large,
                    "also the large ones, which are otherwise run by name only");
  command->add_flag("--list", options->list, "only list the benchmarks");
  command->callback([options, &action] { action = [options] { return bench(*options); }; });
}

}  // namespace flowslide::cli
