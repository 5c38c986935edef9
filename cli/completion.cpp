#include "cli/command.hpp"
#include "cli/command_table.hpp"
#include "workflows/engine/program_version.hpp"

#include <map>
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

/// As a pattern of `case`.
std::string pattern(const std::string& name) {
  const std::size_t space = name.find(' ');
  return space == std::string::npos ? name : name.substr(0, space) + "\\" + name.substr(space);
}

std::string first_word(const CommandRow& c) { return c.name.substr(0, c.name.find(' ')); }

/// Commands of two words, by the first.
std::map<std::string, std::vector<const CommandRow*>> commands_below(
    const std::vector<CommandRow>& table) {
  std::map<std::string, std::vector<const CommandRow*>> below;
  for (const CommandRow& c : table)
    if (c.name.find(' ') != std::string::npos) below[first_word(c)].push_back(&c);
  return below;
}

std::string second_word(const CommandRow& c) { return c.name.substr(c.name.find(' ') + 1); }

std::string bash_command(const CommandRow& c) {
  std::string names = "--help", values;
  for (const OptionRow& o : c.options) {
    if (o.positional) continue;
    if (o.name != "--help") names += " " + o.name;
    if (o.takes != Takes::nothing)
      values +=
          fmt::format("    {}:{}) {}; return ;;\n", pattern(c.name), o.name, bash_words(c, o.takes));
  }
  const OptionRow* first = positional(c);
  return values + fmt::format(
                      "    {0}:*)\n      if [[ $cur == -* ]]; then\n"
                      "        mapfile -t COMPREPLY < <(compgen -W \"{1}\" -- \"$cur\")\n"
                      "      else\n        {2}\n      fi ;;\n",
                      pattern(c.name), names, first ? bash_words(c, first->takes) : ":");
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
  std::string text = fmt::format("    {})\n      _arguments", pattern(c.name));
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
    if (const std::string word = " " + first_word(c); !commands.ends_with(word)) commands += word;
    cases += bash_command(c);
  }
  std::string below;
  for (const auto& [word, list] : commands_below(table)) {
    std::string words;
    for (const CommandRow* c : list) words += (words.empty() ? "" : " ") + second_word(*c);
    below += fmt::format(
        "  if [[ $command == {0} ]]; then\n"
        "    if [ \"$COMP_CWORD\" -eq 2 ]; then\n"
        "      mapfile -t COMPREPLY < <(compgen -W \"{1}\" -- \"$cur\")\n"
        "      return\n"
        "    fi\n"
        "    command=\"{0} ${{COMP_WORDS[2]}}\"\n"
        "  fi\n",
        word, words);
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
      "  local command=${{COMP_WORDS[1]}}\n{}"
      "  case $command:$before in\n{}  esac\n"
      "}}\n"
      "complete -F _flowslide flowslide\n",
      commands, below, cases);
}

std::string zsh_completion(const std::vector<CommandRow>& table) {
  std::string commands, cases;
  for (const CommandRow& c : table) {
    if (c.name.find(' ') == std::string::npos)
      commands += fmt::format("    '{}:{}'\n", c.name, zsh_text(c.doc));
    cases += zsh_command(c);
  }
  std::string below;
  for (const auto& [word, list] : commands_below(table)) {
    std::string words, lines;
    for (const CommandRow* c : list) {
      words += (words.empty() ? "" : ", ") + second_word(*c);
      lines += fmt::format("        '{}:{}'\n", second_word(*c), zsh_text(c->doc));
    }
    commands += fmt::format("    '{}:{}'\n", word, words);
    below += fmt::format(
        "  if [[ $command == {0} ]]; then\n"
        "    if (( CURRENT == 2 )); then\n"
        "      commands=(\n{1}      )\n"
        "      _describe command commands\n"
        "      return\n"
        "    fi\n"
        "    command=\"{0} $words[2]\"\n"
        "    shift words\n"
        "    (( CURRENT-- ))\n"
        "  fi\n",
        word, lines);
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
      "  (( CURRENT-- ))\n{}"
      "  case $command in\n{}  esac\n"
      "fi\n",
      commands, below, cases);
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
