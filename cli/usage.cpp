#include "cli/usage.hpp"

#include "config/yaml.hpp"
#include "core/check.hpp"
#include "core/units.hpp"

#include <algorithm>
#include <filesystem>
#include <string_view>
#include <system_error>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace flowslide::cli {
namespace {

/// The last command that was named.
const CLI::App* named_command(const CLI::App& app) {
  const CLI::App* command = &app;
  while (!command->get_subcommands().empty()) command = command->get_subcommands().front();
  return command;
}

/// Name of an option as it is written, without a value.
std::string bare(std::string_view word) { return std::string(word.substr(0, word.find('='))); }

/// The option of `command` that an unknown one may be meant for.
std::string hint(const CLI::App& command, const std::string& word) {
  std::vector<std::string> known;
  for (const CLI::Option* option : command.get_options())
    for (const std::string& name : option->get_lnames()) known.push_back("--" + name);
  if (std::find(known.begin(), known.end(), bare(word)) != known.end()) return {};
  const auto near = nearest(bare(word), known);
  return near ? fmt::format(" Did you mean '{}'?", *near) : "";
}

/// A value with a blank in it that the shell has parted: --set a.b=1 m
bool parted(const std::vector<std::string>& words, const std::string& left_over) {
  const auto at = std::find(words.begin(), words.end(), left_over);
  return at - words.begin() >= 2 && *(at - 2) == "--set";
}

std::string why_blank(const std::string& text, const char* expected) {
  if (text.find_first_not_of(" \t\r\n") != std::string::npos) return {};
  return fmt::format("is {} ({} is expected; an unset variable of the shell?)",
                     text.empty() ? "empty" : "blank", expected);
}

}  // namespace

void check_commands(const CLI::App& app, int argc, char** argv) {
  const CLI::App* above = &app;
  std::string path = "flowslide";
  for (int i = 1; i < argc && argv[i][0] != '-'; ++i) {
    const std::string word = argv[i];
    std::vector<std::string> names;
    for (const CLI::App* command : above->get_subcommands({}))
      if (!command->get_group().empty() || command->get_name() == word)
        names.push_back(command->get_name());
    if (names.empty()) return;
    if (std::find(names.begin(), names.end(), word) == names.end()) {
      const auto near = nearest(word, names);
      throw InputError(fmt::format("there is no command '{}'. {}", word,
                                   near ? fmt::format("Did you mean '{} {}'?", path, *near)
                                        : fmt::format("Known: {}.", fmt::join(names, ", "))));
    }
    above = above->get_subcommand(word);
    path += " " + word;
  }
}

std::string usage_problem(const CLI::App& app, int argc, char** argv,
                          const CLI::ParseError& error) {
  const std::vector<std::string> words(argv, argv + argc);
  if (dynamic_cast<const CLI::ExtrasError*>(&error) == nullptr)
    return fmt::format("{} ('flowslide --help' lists what there is)", error.what());
  const std::vector<std::string> left = app.remaining(true);
  std::vector<std::string> in_order;
  for (const std::string& word : words)
    if (std::find(left.begin(), left.end(), word) != left.end()) in_order.push_back(word);
  const CLI::App& command = *named_command(app);
  for (const std::string& word : in_order)
    if (word.starts_with("-"))
      return fmt::format("there is no option '{}'.{} ('{} --help' lists what there is)", bare(word),
                         hint(command, word),
                         &command == &app ? "flowslide" : "flowslide " + command.get_name());
  std::string why;
  if (!in_order.empty() && parted(words, in_order.front()))
    why = fmt::format(" Put a value that has a blank in quotes: --set '{} {}'.",
                      *(std::find(words.begin(), words.end(), in_order.front()) - 1),
                      in_order.front());
  return fmt::format("'{}' is not expected here.{} ('flowslide --help' lists what there is)",
                     fmt::join(in_order, " "), why);
}

CLI::Validator input_name() {
  return CLI::Validator([](const std::string& name) { return why_blank(name, "a name"); }, "");
}

void check_unit(const std::optional<std::string>& unit) {
  if (!unit) return;
  try {
    (void)unit_factor(*unit, Dim::acceleration);
  } catch (const InputError& e) {
    throw InputError(fmt::format("--unit: {}", e.what()));
  }
}

void refuse_same_file(const std::string& in, const std::string& out) {
  std::error_code unknown;
  if (std::filesystem::equivalent(in, out, unknown))
    throw InputError(fmt::format(
        "'{}' is the file that is read (its content would be lost) give another name", out));
}

CLI::Validator some_value() {
  return CLI::Validator([](const std::string& text) { return why_blank(text, "a value"); }, "");
}

CLI::Validator output_name() {
  return CLI::Validator(
      [](const std::string& name) -> std::string {
        if (const std::string why = why_blank(name, "a name"); !why.empty()) return why;
        if (name[0] == '~')
          return fmt::format("'{}': '~' is not expanded; write the folder in full", name);
        return {};
      },
      "");
}

}  // namespace flowslide::cli
