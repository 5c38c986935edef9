#include "cli/command.hpp"
#include "cli/command_table.hpp"
#include "workflows/engine/program_version.hpp"

#include <memory>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

namespace flowslide::cli {
namespace {

const OptionRow* positional(const CommandRow& c) {
  return c.options.empty() || !c.options.front().positional ? nullptr : &c.options.front();
}

/// What bash offers for an argument.
std::string bash_words(const CommandRow& c, Takes takes) {
  switch (takes) {
    case Takes::nothing:
    case Takes::text:
      return ":";
    case Takes::file:
      return "compopt -o filenames; mapfile -t COMPREPLY < <(compgen -f -- \"$cur\")";
    case Takes::yaml:
      return "compopt -o filenames; mapfile -t COMPREPLY < <(compgen -f -X '!*.y*ml' -- \"$cur\"; "
             "compgen -d -- \"$cur\")";
    case Takes::folder:
      return "compopt -o filenames; mapfile -t COMPREPLY < <(compgen -d -- \"$cur\")";
    case Takes::cases:
      return fmt::format(
          "mapfile -t COMPREPLY < <(compgen -W \"$(\"$1\" {} --list 2>/dev/null | cut -d' ' -f1)\" "
          "-- \"$cur\")",
          c.name);
  }
  return ":";
}

std::string bash_command(const CommandRow& c) {
  std::string names = "--help", values;
  for (const OptionRow& o : c.options) {
    if (o.positional) continue;
    if (o.name != "--help") names += " " + o.name;
    if (o.takes != Takes::nothing)
      values += fmt::format("    {}:{}) {}; return ;;\n", c.name, o.name, bash_words(c, o.takes));
  }
  const OptionRow* first = positional(c);
  return values + fmt::format(
                      "    {0}:*)\n      if [[ $cur == -* ]]; then\n"
                      "        mapfile -t COMPREPLY < <(compgen -W \"{1}\" -- \"$cur\")\n"
                      "      else\n        {2}\n      fi ;;\n",
                      c.name, names, first ? bash_words(c, first->takes) : ":");
}

/// Inside '...' of a zsh specification, where brackets and colons have a meaning too.
std::string zsh_text(const std::string& text) {
  std::string result;
  for (char c : text) {
    if (c == '\'')
      result += "'\\''";
    else if (c == '[' || c == ']' || c == ':')
      (result += '\\') += c;
    else
      result += c;
  }
  return result;
}

std::string zsh_action(const CommandRow& c, Takes takes) {
  switch (takes) {
    case Takes::nothing:
      return "";
    case Takes::text:
      return "";
    case Takes::file:
      return "_files";
    case Takes::yaml:
      return "_files -g \"*.(yaml|yml)\"";
    case Takes::folder:
      return "_files -/";
    case Takes::cases:
      return fmt::format("( $(flowslide {} --list 2>/dev/null | cut -d\" \" -f1) )", c.name);
  }
  return "";
}

std::string zsh_command(const CommandRow& c) {
  std::string text = fmt::format("    {})\n      _arguments", c.name);
  for (const OptionRow& o : c.options) {
    const std::string action = zsh_action(c, o.takes);
    if (o.positional)
      text += fmt::format(" \\\n        '{}:{}:{}'", o.many ? "*" : "", zsh_text(o.name), action);
    else if (o.takes == Takes::nothing)
      text += fmt::format(" \\\n        '{}[{}]'", o.name, zsh_text(o.doc));
    else
      text += fmt::format(" \\\n        '{}{}[{}]:value:{}'", o.many ? "*" : "", o.name,
                          zsh_text(o.doc), action);
  }
  return text + " ;;\n";
}

}  // namespace

std::string bash_completion(const std::vector<CommandRow>& table) {
  std::string commands = "--help --version", cases;
  for (const CommandRow& c : table) {
    commands += " " + c.name;
    cases += bash_command(c);
  }
  return fmt::format(
      "# bash completion of flowslide\n"
      "_flowslide() {{\n"
      "  local cur=${{COMP_WORDS[COMP_CWORD]}} before=${{COMP_WORDS[COMP_CWORD-1]}}\n"
      "  COMPREPLY=()\n"
      "  if [ \"$COMP_CWORD\" -eq 1 ]; then\n"
      "    mapfile -t COMPREPLY < <(compgen -W \"{}\" -- \"$cur\")\n"
      "    return\n"
      "  fi\n"
      "  case ${{COMP_WORDS[1]}}:$before in\n{}  esac\n"
      "}}\n"
      "complete -F _flowslide flowslide\n",
      commands, cases);
}

std::string zsh_completion(const std::vector<CommandRow>& table) {
  std::string commands, cases;
  for (const CommandRow& c : table) {
    commands += fmt::format("    '{}:{}'\n", c.name, zsh_text(c.doc));
    cases += zsh_command(c);
  }
  return fmt::format(
      "#compdef flowslide\n"
      "local -a commands\n"
      "commands=(\n{})\n"
      "if (( CURRENT == 2 )); then\n"
      "  _describe command commands\n"
      "else\n"
      "  local command=$words[2]\n"
      "  shift words\n"
      "  (( CURRENT-- ))\n"
      "  case $command in\n{}  esac\n"
      "fi\n",
      commands, cases);
}

void add_completion(CLI::App& app, Command& action) {
  auto what = std::make_shared<std::string>();
  CLI::App* command =
      app.add_subcommand("completion", "Print the completion of a shell, or the manual page");
  command->add_option("what", *what, "bash, zsh or man")
      ->required()
      ->check(CLI::IsMember({"bash", "zsh", "man"}));
  command->callback([what, &app, &action] {
    action = [what, &app] {
      const std::vector<CommandRow> table = command_table(app);
      fmt::print("{}", *what == "bash"  ? bash_completion(table)
                       : *what == "zsh" ? zsh_completion(table)
                                        : man_page(table, program_version()));
      return 0;
    };
  });
}

}  // namespace flowslide::cli
