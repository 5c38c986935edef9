#include "cli/case_list.hpp"
#include "cli/command.hpp"
#include "cli/terminal.hpp"
#include "cli/usage.hpp"

#include <algorithm>
#include <cstdio>
#include <memory>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

namespace flowslide::cli {
namespace {

struct VerifyOptions {
  std::vector<std::string> names;
  bool json = false, quick = false, list = false;
};

constexpr int kNumericsFailed = 3;

void print_list(const std::vector<VerificationCase>& cases) {
  for (const VerificationCase& c : cases)
    print_row(stdout, fmt::format("{:<26} ", c.name),
              fmt::format("{}{}", c.doc, c.quick ? " (quick)" : ""));
}

int verify(const VerifyOptions& options) {
  const auto cases = select(all_verification_cases(), options.names, options.quick);
  if (options.list) {
    print_list(cases);
    return 0;
  }
  if (!options.json) fmt::print("{}\n", check_heading());
  std::vector<Check> all;
  for (const VerificationCase& c : cases) {
    std::string message;
    for (Check& check : run_case(c, message)) {
      if (!options.json) fmt::print("{}\n", check_row(check));
      all.push_back(std::move(check));
    }
    if (!message.empty()) fmt::print(stderr, "error: {}\n", message);
    std::fflush(stdout);
  }
  const auto failed = std::count_if(all.begin(), all.end(), [](const Check& c) { return !c.pass; });
  if (options.json)
    fmt::print("{}\n", checks_json(all));
  else
    fmt::print("{} of {} checks pass\n", std::ssize(all) - failed, all.size());
  return failed > 0 ? kNumericsFailed : 0;
}

}  // namespace

void add_verify(CLI::App& app, Command& action) {
  auto options = std::make_shared<VerifyOptions>();
  CLI::App* command =
      app.add_subcommand("verify", "Compare the program with known answers; exit 3 if one fails");
  command->add_option("names", options->names, "groups or cases [all]")->check(input_name());
  command->add_flag("--json", options->json, "as JSON");
  command->add_flag("--quick", options->quick, "only the cases marked quick, less than a minute");
  command->add_flag("--list", options->list, "only list the cases");
  command->callback([options, &action] { action = [options] { return verify(*options); }; });
}

}  // namespace flowslide::cli
