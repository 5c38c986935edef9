#include "cli/command.hpp"
#include "cli/processors.hpp"
#include "cli/signals.hpp"
#include "cli/terminal.hpp"
#include "cli/usage.hpp"
#include "config/yaml.hpp"
#include "core/check.hpp"
#include "core/files.hpp"
#include "study/run/store.hpp"
#include "workflows/engine/headlines.hpp"
#include "workflows/engine/lock.hpp"
#include "workflows/engine/publish.hpp"
#include "workflows/engine/runner.hpp"
#include "workflows/stages/stage_list.hpp"

#include <algorithm>
#include <memory>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

namespace fs = std::filesystem;

namespace flowslide::cli {
namespace {

struct RunArguments {
  std::string file, out;
  int threads = 0;
  std::vector<std::string> overrides, redo, allowed_programs;
  bool dry_run = false;
};

/// Results are the same for any number; more than there are only wait for each other.
int threads_for(int wanted) {
  const int most = processors();
  if (wanted > most)
    fmt::print(stderr, "note: {} threads on {} processors (more would wait): {} are used\n", wanted,
               most, most);
  return wanted > 0 ? std::min(wanted, most) : most;
}

void check_redo(const RunArguments& args, const Workflow& workflow) {
  std::vector<std::string> names;
  for (const WorkflowStage& stage : workflow.stages) names.push_back(stage.name);
  for (const std::string& wanted : args.redo) {
    if (std::find(names.begin(), names.end(), wanted) != names.end()) continue;
    const auto near = nearest(wanted, names);
    throw InputError(fmt::format("--redo {}: there is no stage of this name in {}. {}", wanted,
                                 args.file,
                                 near ? fmt::format("Did you mean '{}'?", *near)
                                      : fmt::format("Known: {}.", fmt::join(names, ", "))));
  }
}

void print_result(const fs::path& folder, std::size_t warnings, const Expectation& time) {
  const SealedJson file = read_sealed(folder / kResultFile);
  if (!file.json)
    throw FileError(
        fmt::format("{}: cannot be read back ({})", (folder / kResultFile).string(), file.problem));
  const nlohmann::ordered_json& result = *file.json;
  const bool narrow = ::isatty(STDOUT_FILENO) == 1 && terminal_columns(STDOUT_FILENO) < 60;
  const int label = narrow ? 24 : 30;
  for (const Headline& h : headlines_of(result.dump())) {
    const auto value = result.find(h.fact);
    if (value == result.end() || !value->is_number()) continue;
    print_wrapped(stdout, fmt::format("{:<{}} ", h.text, label),
                  fmt::format("{:.4g}{}{}{}", value->get<double>(), h.unit.empty() ? "" : " ",
                              h.unit, h.note.empty() ? "" : " (" + h.note + ")"));
  }
  if (time.expected > 0.0)
    print_wrapped(
        stdout, fmt::format("{:<{}} ", "computing time", label),
        fmt::format("{}, {} expected ({:+.0f} %)", about_seconds(time.taken),
                    about_seconds(time.expected), 100.0 * (time.taken / time.expected - 1.0)));
  if (warnings > 0) fmt::print("{:<{}} {}, see above\n", "warnings before use", label, warnings);
  fmt::print("{:<{}} {}\n", "result", label, (folder / kResultFile).string());
}

/// What is up to date is left out.
int dry_run(const Workflow& workflow, const fs::path& folder, const CostBook& costs, int threads,
            Display& display) {
  Expectation all;
  for (const PlanLine& line : plan_workflow(workflow, folder, &costs, threads)) {
    for (const std::string& problem : line.decision.problems)
      display.notice(fmt::format("{}: {}", line.stage, problem));
    display.plan(line.stage, line.decision);
    if (line.decision.action != Action::reuse) all.add(line.decision.expected);
  }
  if (all.expected > 0.0)
    print_wrapped(stdout, "expected: ",
                  fmt::format("about {} with {} thread{}, {}{}", about_seconds(all.expected),
                              threads, threads == 1 ? "" : "s", about_bytes(all.memory),
                              all.unknown > 0 ? ", and what nothing is known of" : ""));
  return 0;
}

int run(const RunArguments& args) {
  fs::path folder = args.out;
  if (folder.empty())
    folder = fs::path("runs") / workflow_name(load_yaml(args.file, args.overrides));
  if (is_there(folder / study::kPlanFile))
    throw InputError(fmt::format(
        "{}: holds a study (the result of a single run would be mixed with its own). Choose another "
        "--out.",
        folder.string()));
  const Workflow workflow = load_workflow(args.file, args.overrides, all_stages());
  check_redo(args, workflow);
  Display display(::isatty(STDOUT_FILENO) == 1);
  for (const WorkflowStage& stage : workflow.stages)
    display.events().warned(stage.name, stage.warnings);
  CostBook costs(usual_cost_file());
  if (args.dry_run) return dry_run(workflow, folder, costs, threads_for(args.threads), display);
  const RunOptions options{.folder = folder,
                           .threads = threads_for(args.threads),
                           .stop_requested = &stop_on_signal(),
                           .redo = args.redo,
                           .allowed_programs = args.allowed_programs,
                           .costs = &costs};
  try {
    run_workflow(workflow, options, display.events());
  } catch (...) {
    display.close();
    throw;
  }
  costs.keep();
  print_result(folder, display.num_warnings(), display.expectation());
  return 0;
}

/// The workflow of a run folder, with the stages that write reports done again and no other.
int report(const std::string& folder, const std::vector<std::string>& allowed_programs) {
  if (!is_there(folder))
    throw InputError(fmt::format(
        "{}: no run folder (there is no such folder). Name the folder of a finished run.", folder));
  const auto [lock, problem] = read_lock(folder);
  if (!lock)
    throw InputError(fmt::format("{}: no run folder ({}). Name the folder of a finished run.",
                                 folder, problem.empty() ? "it has no run.lock" : problem));
  const Workflow workflow = load_workflow(lock->file, lock->overrides, all_stages());
  RunOptions options{.folder = folder,
                     .threads = processors(),
                     .stop_requested = &stop_on_signal(),
                     .redo = {},
                     .allowed_programs = allowed_programs,
                     .costs = nullptr};
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
  print_result(folder, display.num_warnings(), display.expectation());
  return 0;
}

void add_allow_python(CLI::App& command, std::vector<std::string>& programs) {
  command
      .add_option("--allow-python", programs, "interpreter that the workflow may name in 'python'")
      ->take_all()
      ->allow_extra_args(false);
}

}  // namespace

void add_run(CLI::App& app, Command& action) {
  auto args = std::make_shared<RunArguments>();
  CLI::App* command =
      app.add_subcommand("run", "Run the stages of a workflow that are not up to date");
  command->add_option("file", args->file, "workflow, FILE.yaml")->required()->check(input_name());
  command->add_option("--out", args->out, "folder of the results [runs/<name of the workflow>]")
      ->check(output_name());
  command->add_option("--threads", args->threads, "number of threads [all]")
      ->check(CLI::Range(1, 4096));
  command->add_option("--set", args->overrides, "override a setting: stages.map.with.cell=2m")
      ->take_all()
      ->allow_extra_args(false);
  command->add_option("--redo", args->redo, "stage to run again even if it is up to date")
      ->take_all()
      ->allow_extra_args(false);
  add_allow_python(*command, args->allowed_programs);
  command->add_flag("--dry-run", args->dry_run, "only tell what would run, and why");
  command->callback([args, &action] { action = [args] { return run(*args); }; });
}

void add_check(CLI::App& app, Command& action) {
  auto args = std::make_shared<RunArguments>();
  CLI::App* command = app.add_subcommand("check", "Check a workflow without running it");
  command->add_option("file", args->file, "workflow, FILE.yaml")->required()->check(input_name());
  command->add_option("--set", args->overrides, "override a setting")
      ->take_all()
      ->allow_extra_args(false);
  command->callback([args, &action] {
    action = [args] {
      const Workflow workflow = load_workflow(args->file, args->overrides, all_stages());
      std::size_t warnings = 0;
      for (const WorkflowStage& stage : workflow.stages)
        for (const std::string& text : stage.warnings) {
          print_warning(fmt::format("{}: {}", stage.name, text));
          ++warnings;
        }
      for (const WorkflowStage& stage : workflow.stages)
        for (const std::string& program : stage.prepared.programs)
          print_wrapped(stderr, "note: ",
                        fmt::format("{}: would start '{}', which `run` does with --allow-python "
                                    "'{}' only",
                                    stage.name, program, program));
      fmt::print("{}: {} stages, {}\n", args->file, workflow.stages.size(),
                 warnings == 0   ? "no problem found"
                 : warnings == 1 ? "1 warning"
                                 : fmt::format("{} warnings", warnings));
      return 0;
    };
  });
}

void add_report(CLI::App& app, Command& action) {
  auto folder = std::make_shared<std::string>();
  auto programs = std::make_shared<std::vector<std::string>>();
  CLI::App* command = app.add_subcommand("report", "Build the report of a finished run again");
  command->add_option("folder", *folder, "run folder, DIR")->required()->check(input_name());
  add_allow_python(*command, *programs);
  command->callback([folder, programs, &action] {
    action = [folder, programs] { return report(*folder, *programs); };
  });
}

}  // namespace flowslide::cli
