#include "cli/command.hpp"
#include "cli/signals.hpp"
#include "cli/terminal.hpp"
#include "workflows/engine/run_folder.hpp"
#include "workflows/engine/runner.hpp"
#include "workflows/stages/stage_list.hpp"

#include <algorithm>
#include <fstream>
#include <memory>
#include <sched.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace fs = std::filesystem;

namespace flowslide::cli {
namespace {

struct RunArguments {
  std::string file, out;
  int threads = 0;
  std::vector<std::string> overrides;
  bool dry_run = false;
};

/// Processors that this process may use.
int available_threads() {
  cpu_set_t set;
  return sched_getaffinity(0, sizeof set, &set) == 0 ? std::max(1, CPU_COUNT(&set)) : 1;
}

/// Results are the same for any number; more than there are only wait for each other.
int threads_for(int wanted) {
  const int most = available_threads();
  if (wanted > most)
    fmt::print(stderr, "note: {} threads on {} processors (more would wait): {} are used\n", wanted,
               most, most);
  return wanted > 0 ? std::min(wanted, most) : most;
}

/// Input that is refused must not leave an earlier result.json that looks like its result.
Workflow load_or_withdraw(const RunArguments& args, const fs::path& folder) {
  try {
    return load_workflow(args.file, args.overrides, all_stages());
  } catch (const Error&) {
    if (!args.dry_run && fs::exists(folder / kResultFile)) RunFolder(folder).withdraw();
    throw;
  }
}

void print_result(const fs::path& folder) {
  std::ifstream in(folder / kResultFile);
  const auto result = nlohmann::json::parse(in);
  const auto line = [&](const char* key, const char* text, const char* unit) {
    if (result[key].is_number())
      fmt::print("{:<30} {:.4g}{}{}\n", text, result[key].get<double>(), *unit ? " " : "", unit);
  };
  line("runout_m", "runout", "m");
  line("liquefaction_depth_pond_m", "liquefaction depth, pond", "m");
  line("liquefaction_depth_crest_m", "liquefaction depth, crest", "m");
  line("transfer_time_s", "transfer at", "s");
  line("mass_error", "mass error", "");
  line("energy_error", "energy error", "");
  fmt::print("{:<30} {}\n", "result", (folder / kResultFile).string());
}

int run(const RunArguments& args) {
  fs::path folder = args.out;
  if (folder.empty())
    folder = fs::path("runs") / workflow_name(load_yaml(args.file, args.overrides));
  const Workflow workflow = load_or_withdraw(args, folder);
  Display display(::isatty(STDOUT_FILENO) == 1);
  if (args.dry_run) {
    for (const PlanLine& line : plan_workflow(workflow, folder))
      display.plan(line.stage, line.decision);
    return 0;
  }
  const RunOptions options{.folder = folder,
                           .threads = threads_for(args.threads),
                           .stop_requested = &stop_on_signal(),
                           .redo = {}};
  try {
    run_workflow(workflow, options, display.events());
  } catch (...) {
    display.close();
    throw;
  }
  print_result(folder);
  return 0;
}

/// The workflow of a run folder, with the stages that write reports done again and no other.
int report(const std::string& folder) {
  const auto lock = read_lock(folder);
  if (!lock)
    throw InputError(
        fmt::format("{}: no run folder (it has no run.lock that this program reads). "
                    "Name the folder of a finished run.",
                    folder));
  const Workflow workflow = load_workflow(lock->file, lock->overrides, all_stages());
  RunOptions options{.folder = folder,
                     .threads = available_threads(),
                     .stop_requested = &stop_on_signal(),
                     .redo = {}};
  for (const PlanLine& line : plan_workflow(workflow, folder)) {
    const auto stage = std::find_if(workflow.stages.begin(), workflow.stages.end(),
                                    [&](const WorkflowStage& s) { return s.name == line.stage; });
    if (stage->type.name.starts_with("report."))
      options.redo.push_back(line.stage);
    else if (line.decision.action != Action::reuse)
      throw InputError(fmt::format(
          "{}: stage {} is not up to date ({}) and a report tells of finished stages only. "
          "Run 'flowslide run {} --out {}' first.",
          folder, line.stage, line.decision.why, lock->file, folder));
  }
  if (options.redo.empty())
    throw InputError(
        fmt::format("{}: its workflow has no report stage. Add one, 'uses: "
                    "report.runout'.",
                    lock->file));
  Display display(::isatty(STDOUT_FILENO) == 1);
  run_workflow(workflow, options, display.events());
  print_result(folder);
  return 0;
}

}  // namespace

void add_run(CLI::App& app, Command& action) {
  auto args = std::make_shared<RunArguments>();
  CLI::App* command =
      app.add_subcommand("run", "Run the stages of a workflow that are not up to date");
  command->add_option("file", args->file, "workflow, FILE.yaml")->required();
  command->add_option("--out", args->out, "folder of the results [runs/<name of the workflow>]");
  command->add_option("--threads", args->threads, "number of threads [all]")
      ->check(CLI::Range(1, 4096));
  command->add_option("--set", args->overrides, "override a setting: stages.map.with.cell=2m")
      ->take_all()
      ->allow_extra_args(false);
  command->add_flag("--dry-run", args->dry_run, "only tell what would run, and why");
  command->callback([args, &action] { action = [args] { return run(*args); }; });
}

void add_check(CLI::App& app, Command& action) {
  auto args = std::make_shared<RunArguments>();
  CLI::App* command = app.add_subcommand("check", "Check a workflow without running it");
  command->add_option("file", args->file, "workflow, FILE.yaml")->required();
  command->add_option("--set", args->overrides, "override a setting")
      ->take_all()
      ->allow_extra_args(false);
  command->callback([args, &action] {
    action = [args] {
      const Workflow workflow = load_workflow(args->file, args->overrides, all_stages());
      fmt::print("{}: {} stages, no problem found\n", args->file, workflow.stages.size());
      return 0;
    };
  });
}

void add_report(CLI::App& app, Command& action) {
  auto folder = std::make_shared<std::string>();
  CLI::App* command = app.add_subcommand("report", "Build the report of a finished run again");
  command->add_option("folder", *folder, "run folder, DIR")->required();
  command->callback([folder, &action] { action = [folder] { return report(*folder); }; });
}

}  // namespace flowslide::cli
