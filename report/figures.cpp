#include "report/figures.hpp"

#include "core/check.hpp"
#include "core/files.hpp"
#include "plot_scripts.hpp"

#include <cerrno>
#include <fcntl.h>
#include <fstream>
#include <iterator>
#include <spawn.h>
#include <sys/wait.h>
#include <system_error>
#include <unistd.h>
#include <utility>

namespace flowslide {
namespace {

constexpr const char* kInstall =
    "(figures need Python 3 with NumPy and Matplotlib) install the Debian package "
    "python3-matplotlib or name an interpreter in the setting 'python', then build the report "
    "again";

/// Runs a program found on the PATH with its output in `log`. Returns its exit status, 127 if it
/// cannot be started, 128 + signal if it was killed.
int run(std::vector<std::string> arguments, const std::filesystem::path& log) {
  std::vector<char*> argv;
  for (std::string& a : arguments) argv.push_back(a.data());
  argv.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, log.c_str(),
                                   O_WRONLY | O_CREAT | O_TRUNC, 0644);
  posix_spawn_file_actions_adddup2(&actions, STDOUT_FILENO, STDERR_FILENO);
  pid_t child = -1;
  const int failed = posix_spawnp(&child, argv[0], &actions, nullptr, argv.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (failed) return 127;
  int status = 0;
  while (waitpid(child, &status, 0) < 0)
    if (errno != EINTR) return 127;
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

std::string last_lines(const std::filesystem::path& log) {
  constexpr std::size_t most = 600;
  std::ifstream file(log);
  std::string text(std::istreambuf_iterator<char>(file), {});
  return text.size() > most ? "..." + text.substr(text.size() - most) : text;
}

std::optional<std::string> find_python(const std::optional<std::string>& wanted,
                                       const std::filesystem::path& log) {
  const std::vector<std::string> candidates =
      wanted ? std::vector{*wanted} : std::vector<std::string>{"python3", "/usr/bin/python3"};
  for (const std::string& python : candidates)
    if (run({python, "-c",
             "import importlib.util as u, sys; "
             "sys.exit(not (u.find_spec('matplotlib') and u.find_spec('numpy')))"},
            log) == 0)
      return python;
  return std::nullopt;
}

void remove_old(const std::filesystem::path& folder) {
  std::error_code ignored;
  for (const Figure& figure : kFigures)
    for (const char* ending : {".svg", ".png"})
      std::filesystem::remove(folder / (std::string(figure.name) + ending), ignored);
}

}  // namespace

DrawnFigures draw_figures(const std::filesystem::path& folder,
                          const std::optional<std::string>& python,
                          const std::vector<std::string>& only) {
  for (const auto& [name, text] : kPlotScripts) write_file(folder / "data" / name, text);
  remove_old(folder / "figures");
  const std::filesystem::path log = folder / "data" / "plot.log";
  DrawnFigures drawn;
  const auto interpreter = find_python(python, log);
  if (!interpreter) {
    drawn.problem =
        fmt::format("No figures were drawn: {} {}.",
                    python ? "'" + *python + "' cannot be used" : "none was found", kInstall);
    return drawn;
  }
  std::vector<std::string> command{*interpreter, "-B", (folder / "data" / "plot.py").string(),
                                   folder.string()};
  command.insert(command.end(), only.begin(), only.end());
  const int status = run(std::move(command), log);
  if (status != 0) {
    drawn.problem = fmt::format(
        "No figures were drawn: {} ended with status {} (see data/plot.log) run data/plot.py by "
        "hand to find the cause:\n{}",
        *interpreter, status, last_lines(log));
    return drawn;
  }
  std::error_code ignored;
  std::filesystem::remove(log, ignored);
  for (const Figure& figure : kFigures)
    if (std::filesystem::exists(folder / "figures" / (std::string(figure.name) + ".png")))
      drawn.figures.push_back(figure);
  return drawn;
}

}  // namespace flowslide
