#include "report/plot_runner.hpp"

#include "core/check.hpp"
#include "core/files.hpp"
#include "core/temporary_folder.hpp"
#include "plot_scripts.hpp"
#include "report/helper_program.hpp"

namespace fs = std::filesystem;

namespace flowslide {
namespace {

constexpr double kLookSeconds = 60.0;  ///< for the question what an interpreter has
constexpr int kSystemError = 74;       ///< of plot.py, see there
constexpr std::uint64_t kLongestLog = 1u << 30;

/// Arguments of an isolated interpreter: no variables, no packages of the user, nothing imported
/// from the working folder or from that of a script. The modules are those of `scripts`.
std::vector<std::string> isolated(const std::string& python, const char* code) {
  return {python, "-I", "-B", "-c", code};
}

std::string last_lines(const fs::path& log, const std::string& scripts) {
  constexpr std::size_t most = 600;
  if (!is_there(log)) return "";
  std::string text = read_file(log, kLongestLog);
  // The folder has another name each time; the report must not.
  for (std::size_t at; (at = text.find(scripts)) != std::string::npos;)
    text.replace(at, scripts.size(), "plot/");
  return text.size() > most ? "..." + text.substr(text.size() - most) : text;
}

struct Interpreter {
  std::string name;
  int status = 0;  ///< 0 if it has what figures need
};

/// The first that will do, else the last that was tried.
Interpreter find_python(const std::optional<std::string>& wanted, const TemporaryFolder& work,
                        const Progress& progress) {
  const std::vector<std::string> candidates =
      wanted ? std::vector{*wanted} : std::vector<std::string>{"python3", "/usr/bin/python3"};
  Interpreter tried;
  for (const std::string& python : candidates) {
    tried = {python, run_helper({isolated(python,
                                          "import importlib.util as u, sys; "
                                          "sys.exit(not (u.find_spec('matplotlib') and "
                                          "u.find_spec('numpy')))"),
                                 work / "", work / "look.log", kLookSeconds},
                                progress)
                         .status};
    if (tried.status == 0) break;
  }
  return tried;
}

/// Why an interpreter will not do.
std::string no_python(const Interpreter& tried, bool wanted, const FigureLimits& limits) {
  constexpr int kNotThere = 127;
  const std::string what = !wanted ? "no interpreter was found"
                           : tried.status == kNotThere
                               ? fmt::format("there is no program '{}'", tried.name)
                               : fmt::format("'{}' cannot draw them", tried.name);
  return fmt::format(
      "No figures were drawn: {} (it takes Python 3 with NumPy and Matplotlib) install the Debian "
      "package python3-matplotlib, or name an interpreter {}, and {}.",
      what, limits.named_by, limits.again);
}

/// Why there are no figures; empty if there are.
std::string problem_of(const HelperOutcome& outcome, const std::string& python,
                       const FigureLimits& limits, const std::string& last_words) {
  if (outcome.timed_out)
    return fmt::format(
        "No figures were drawn: {} had not ended after {:.0f} s (it was ended) look for what "
        "keeps the machine busy, then {}.",
        python, limits.seconds, limits.again);
  if (outcome.status == kSystemError)
    throw FileError(fmt::format("the figures cannot be drawn:\n{}", last_words));
  if (outcome.status != 0)
    return fmt::format(
        "No figures were drawn: {} ended with status {} (the cause is in its last words) mend it "
        "and {}:\n{}",
        python, outcome.status, limits.again, last_words);
  return "";
}

}  // namespace

std::vector<std::string> write_plot_scripts(const fs::path& folder) {
  std::vector<std::string> files;
  for (const auto& [name, text] : kPlotScripts) {
    write_file(folder / name, text);
    files.push_back((folder.filename() / name).generic_string());
  }
  return files;
}

std::string run_plot_script(const std::string& function, const std::vector<std::string>& arguments,
                            const std::optional<std::string>& python, const FigureLimits& limits) {
  const TemporaryFolder work;
  write_plot_scripts(work / "");
  write_file(work / kWorkflowScript.first.data(), kWorkflowScript.second);
  const Interpreter interpreter = find_python(python, work, limits.progress);
  if (interpreter.status != 0) return no_python(interpreter, python.has_value(), limits);
  HelperRun run{.arguments = isolated(interpreter.name,
                                      "import sys; sys.path.insert(0, sys.argv[1]); "
                                      "import importlib; "
                                      "m, f = sys.argv[2].split('.'); "
                                      "getattr(importlib.import_module(m), f)(*sys.argv[3:])"),
                .folder = work / "",
                .log = work / "plot.log",
                .seconds = limits.seconds};
  run.arguments.push_back((work / "").string());
  run.arguments.push_back(function);
  run.arguments.insert(run.arguments.end(), arguments.begin(), arguments.end());
  const HelperOutcome outcome = run_helper(run, limits.progress);
  return problem_of(outcome, interpreter.name, limits, last_lines(run.log, (work / "").string()));
}

}  // namespace flowslide
