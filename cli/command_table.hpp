#pragma once
#include <string>
#include <vector>

namespace CLI {
class App;
}

/// The commands as data: what the manual page and the completions of shells are written from.
namespace flowslide::cli {

/// What completes an argument.
enum class Takes { nothing, text, file, yaml, folder, cases };

struct OptionRow {
  std::string name;  ///< "--out"; without dashes if the place counts
  std::string doc;
  Takes takes = Takes::nothing;
  bool positional = false, required = false, many = false;
};

struct CommandRow {
  std::string name;  ///< "run", "study run"
  std::string doc;
  std::vector<OptionRow> options;  ///< positional ones first, in their order
};

std::vector<CommandRow> command_table(const CLI::App& app);

/// roff, section 1.
std::string man_page(const std::vector<CommandRow>& table, const std::string& version);
/// To be sourced, or installed as bash-completion/completions/flowslide.
std::string bash_completion(const std::vector<CommandRow>& table);
/// To be installed as _flowslide in a folder of $fpath.
std::string zsh_completion(const std::vector<CommandRow>& table);

}  // namespace flowslide::cli
