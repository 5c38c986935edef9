#include "cli/command.hpp"
#include "cli/short_waits.hpp"
#include "core/check.hpp"
#include "workflows/engine/program_version.hpp"

#include <cstdio>
#include <exception>
#include <new>
#include <sstream>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

namespace {

/// Every line of a message is an error of its own.
void print_errors(const std::string& text) {
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);)
    if (!line.empty()) fmt::print(stderr, "error: {}\n", line);
}

int run(int argc, char** argv) {
  CLI::App app{"From an earthquake record to the runout of a liquefied tailings dam", "flowslide"};
  app.set_version_flag("--version", flowslide::program_version());
  app.require_subcommand(1);
  flowslide::cli::Command action;
  flowslide::cli::add_run(app, action);
  flowslide::cli::add_check(app, action);
  flowslide::cli::add_inspect(app, action);
  flowslide::cli::add_motion(app, action);
  flowslide::cli::add_point(app, action);
  flowslide::cli::add_convert(app, action);
  flowslide::cli::add_report(app, action);
  flowslide::cli::add_verify(app, action);
  flowslide::cli::add_bench(app, action);
  flowslide::cli::add_schema(app, action);
  flowslide::cli::add_docs(app, action);
  flowslide::cli::add_completion(app, action);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    if (e.get_exit_code() == 0) return app.exit(e);  // --help, --version
    print_errors(fmt::format("{} ('flowslide --help' lists what there is)", e.what()));
    return 2;
  }
  const int code = action();
  if (std::fflush(stdout) != 0 || std::ferror(stdout))
    throw flowslide::FileError("standard output: cannot be written (the disk may be full)");
  return code;
}

}  // namespace

int main(int argc, char** argv) {
  flowslide::cli::prefer_short_waits(argv);
  try {
    return run(argc, argv);
  } catch (const flowslide::Error& e) {
    std::fflush(stdout);
    print_errors(e.what());
    return e.exit_code();
  } catch (const std::bad_alloc&) {
    print_errors(
        "out of memory (the model is larger than this machine can hold). Use a coarser "
        "cell or spacing, or a larger machine.");
    return 3;
  } catch (const std::exception& e) {
    print_errors(
        fmt::format("internal error: {} (a defect of the program, not of your input). "
                    "Please report it with the workflow file.",
                    e.what()));
    return 3;
  }
}
