#include "cli/command_table.hpp"

#include <algorithm>

#include <CLI/CLI.hpp>

namespace flowslide::cli {
namespace {

/// The description says what an argument is ("workflow, FILE.yaml"), for people and for this.
Takes taken_by(const CLI::App& command, const CLI::Option& option) {
  const std::string words = option.get_name(true) + " " + option.get_description();
  const auto says = [&words](const char* word) { return words.find(word) != std::string::npos; };
  if (option.get_items_expected_max() == 0) return Takes::nothing;
  if (option.get_positional() && (command.get_name() == "verify" || command.get_name() == "bench"))
    return Takes::cases;
  if (says("YAML") || says("FILE.yaml")) return Takes::yaml;
  if (says("this file") || (option.get_positional() && says("file"))) return Takes::file;
  return says("folder") ? Takes::folder : Takes::text;
}

OptionRow row(const CLI::App& command, const CLI::Option& option) {
  OptionRow r;
  r.positional = option.get_positional();
  r.name = r.positional ? option.get_name(true) : "--" + option.get_lnames().front();
  r.doc = option.get_description();
  r.takes = taken_by(command, option);
  r.required = option.get_required();
  r.many = option.get_items_expected_max() > 1;
  return r;
}

}  // namespace

std::vector<CommandRow> command_table(const CLI::App& app) {
  std::vector<CommandRow> table;
  for (const CLI::App* command : app.get_subcommands(nullptr)) {
    if (command->get_group().empty()) continue;  // of no use to people
    CommandRow c{command->get_name(), command->get_description(), {}};
    for (CommandRow& below : command_table(*command)) {
      below.name = c.name + " " + below.name;
      table.push_back(std::move(below));
    }
    if (!command->get_subcommands(nullptr).empty()) continue;
    for (const CLI::Option* option : command->get_options())
      c.options.push_back(row(*command, *option));
    std::stable_partition(c.options.begin(), c.options.end(),
                          [](const OptionRow& o) { return o.positional; });
    table.push_back(std::move(c));
  }
  return table;
}

}  // namespace flowslide::cli
