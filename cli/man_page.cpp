#include "cli/command_table.hpp"

#include <fmt/format.h>

namespace flowslide::cli {
namespace {

/// Dashes that can be searched and copied, no word of roff by accident.
std::string roff(const std::string& text) {
  std::string result;
  for (char c : text) {
    if (c == '-')
      result += "\\-";
    else if (c == '\\')
      result += "\\e";
    else
      result += c;
  }
  return !result.empty() && (result[0] == '.' || result[0] == '\'') ? "\\&" + result : result;
}

const char* placeholder(Takes takes) {
  switch (takes) {
    case Takes::nothing:
      return "";
    case Takes::text:
      return "VALUE";
    case Takes::file:
      return "FILE";
    case Takes::yaml:
      return "FILE.yaml";
    case Takes::folder:
      return "DIR";
    case Takes::cases:
      return "NAME";
  }
  return "";
}

std::string in_usage(const OptionRow& o) {
  const std::string value = fmt::format("\\fI{}\\fR", roff(placeholder(o.takes)));
  if (!o.positional)
    return fmt::format(" [\\fB{}\\fR{}]{}", roff(o.name),
                       o.takes == Takes::nothing ? "" : " " + value, o.many ? "..." : "");
  const char* many = o.many ? "..." : "";
  return o.required ? fmt::format(" {}{}", value, many) : fmt::format(" [{}{}]", value, many);
}

std::string command_text(const CommandRow& c) {
  std::string usage, options;
  for (const OptionRow& o : c.options) {
    if (o.name == "--help") continue;  // every command has it, as the synopsis says
    usage += in_usage(o);
    options += fmt::format(".TP\n\\fB{}\\fR{}\n{}\n", roff(o.name),
                           o.positional || o.takes == Takes::nothing
                               ? ""
                               : fmt::format(" \\fI{}\\fR", roff(placeholder(o.takes))),
                           roff(o.doc));
  }
  return fmt::format(".SS flowslide {}\n{}.\n.PP\n\\fBflowslide {}\\fR{}\n{}", c.name, roff(c.doc),
                     c.name, usage, options);
}

}  // namespace

std::string man_page(const std::vector<CommandRow>& table, const std::string& version) {
  std::string page = fmt::format(
      ".TH FLOWSLIDE 1 \"\" \"{}\" \"User Commands\"\n"
      ".SH NAME\nflowslide \\- runout of tailings dams that liquefy in an earthquake\n"
      ".SH SYNOPSIS\n\\fBflowslide\\fR \\fICOMMAND\\fR [\\fIOPTION\\fR]...\n.br\n"
      "\\fBflowslide\\fR [\\fICOMMAND\\fR] \\fB\\-\\-help\\fR\n.br\n"
      "\\fBflowslide \\-\\-version\\fR\n"
      ".SH DESCRIPTION\nFrom a section and a ground motion, or from the recorder files of a "
      "dynamic finite\\-element analysis, to the liquefied zone, its residual strength, the "
      "transfer to material points, and the flow to rest. One YAML file describes the chain.\n"
      ".SH COMMANDS\n",
      roff(version));
  for (const CommandRow& c : table) page += command_text(c);
  return page +
         ".SH EXIT STATUS\n"
         ".TP\n0\ndone\n"
         ".TP\n1\nsome rows of a study failed, the others are done\n"
         ".TP\n2\nthe input is wrong\n"
         ".TP\n3\nthe numerics failed\n"
         ".TP\n4\na file could not be read or written\n"
         ".TP\n130\ninterrupted, with a checkpoint\n"
         ".SH EXAMPLES\n.nf\n"
         "flowslide run mochikoshi.yaml \\-\\-set stages.flow.with.cell='5 m'\n"
         "flowslide inspect runs/mochikoshi\n.fi\n";
}

}  // namespace flowslide::cli
