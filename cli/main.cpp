#include "cli/command.hpp"
#include "cli/short_waits.hpp"
#include "cli/signals.hpp"
#include "cli/terminal.hpp"
#include "cli/usage.hpp"
#include "core/check.hpp"
#include "workflows/engine/program_version.hpp"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <iostream>
#include <new>
#include <sstream>
#include <string>
#include <string_view>
#include <system_error>
#include <unistd.h>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

namespace {

constexpr int kNoResources = 4;  ///< exit code where memory, threads or a file are not to be had

/// Every line of a message is an error of its own. Allocates nothing: it may be memory that is
/// short.
void print_errors(std::string_view text) {
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    if (end > 0) flowslide::cli::print_wrapped(stderr, "error: ", text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
}

void print_rows(const std::string& text) {
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) flowslide::cli::print_row(stdout, line);
}

bool main_has_ended = false;

/// Libraries that end the program themselves, as that of the threads does when it gets none, do so
/// with a code that means something else here.
void correct_exit_code() {
  if (!main_has_ended) ::_exit(kNoResources);
}

void flush_output() {
  std::cout.flush();
  constexpr const char* kLost =
      "{}: cannot be written (the disk is full, or who reads it has gone) what a run had to say is "
      "in its result.json too";
  if (std::fflush(stdout) != 0 || std::ferror(stdout))
    throw flowslide::FileError(fmt::format(kLost, "standard output"));
  if (std::ferror(stderr)) throw flowslide::FileError(fmt::format(kLost, "standard error"));
}

int run_command_line(int argc, char** argv) {
  CLI::App app{"From an earthquake record to the runout of a liquefied tailings dam", "flowslide"};
  app.set_version_flag("--version", flowslide::program_version());
  app.require_subcommand(1);
  flowslide::cli::Command action;
  flowslide::cli::add_run(app, action);
  flowslide::cli::add_check(app, action);
  flowslide::cli::add_plot(app, action);
  flowslide::cli::add_inspect(app, action);
  flowslide::cli::add_motion(app, action);
  flowslide::cli::add_point(app, action);
  flowslide::cli::add_convert(app, action);
  flowslide::cli::add_report(app, action);
  flowslide::cli::add_study(app, action);
  flowslide::cli::add_verify(app, action);
  flowslide::cli::add_bench(app, action);
  flowslide::cli::add_schema(app, action);
  flowslide::cli::add_docs(app, action);
  flowslide::cli::add_completion(app, action);
  flowslide::cli::check_commands(app, argc, argv);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    if (e.get_exit_code() == 0) {  // --help, --version
      std::ostringstream text;
      app.exit(e, text, text);
      print_rows(text.str());
      flush_output();
      return 0;
    }
    print_errors(flowslide::cli::usage_problem(app, argc, argv, e));
    return 2;
  }
  const int code = action();
  flush_output();
  return code;
}

int run_and_report(int argc, char** argv) {
  try {
    return run_command_line(argc, argv);
  } catch (const flowslide::Error& e) {
    std::fflush(stdout);
    print_errors(e.what());
    return e.exit_code();
  } catch (const std::filesystem::filesystem_error& e) {
    print_errors(fmt::format("{}: {}", e.path1().string(), e.code().message()));
    return kNoResources;
  } catch (const std::system_error& e) {
    // the only other calls that throw these write to the terminal, a pipe or a file behind it
    print_errors(fmt::format("standard output: cannot be written ({})", e.code().message()));
    return kNoResources;
  } catch (const std::bad_alloc&) {
    print_errors(
        "out of memory (the model is larger than this machine can hold). Use a coarser "
        "cell or spacing, or a larger machine.");
    return kNoResources;
  } catch (const std::exception& e) {
    print_errors(
        fmt::format("internal error: {} (a defect of the program, not of your input). "
                    "Please report it with the workflow file.",
                    e.what()));
    return 3;
  }
}

}  // namespace

int main(int argc, char** argv) {
  std::atexit(correct_exit_code);
  flowslide::cli::prefer_short_waits(argv);
  flowslide::cli::refuse_by_return();
  int code = kNoResources;
  try {
    code = run_and_report(argc, argv);
  } catch (const std::bad_alloc&) {
    print_errors("out of memory");
  }
  main_has_ended = true;
  return code;
}
