#include "cli/command.hpp"
#include "cli/signals.hpp"
#include "cli/study_batch.hpp"
#include "cli/study_display.hpp"
#include "cli/study_pool.hpp"
#include "cli/terminal.hpp"
#include "cli/usage.hpp"
#include "core/check.hpp"
#include "core/files.hpp"
#include "core/hash.hpp"
#include "study/page/page.hpp"
#include "study/run/clean.hpp"
#include "study/run/locks.hpp"
#include "workflows/engine/lock.hpp"
#include "workflows/stages/stage_list.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <memory>
#include <optional>
#include <thread>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

namespace fs = std::filesystem;

namespace flowslide::cli {
namespace {

/// Some rows failed, the others are there.
constexpr int kRowsFailed = 1;

struct StudyArguments {
  std::string file, out, executor = "local";
  int jobs = 0, threads = 0, frames = 0;
  bool dry_run = false, quiet = false, json = false, retry = false, whole = false;
  std::vector<std::string> allowed_programs;
};

/// The study file that a folder is of; empty where it is of none, or its plan cannot be read.
fs::path file_of_study(const fs::path& folder) {
  if (!is_there(folder / study::kPlanFile)) return {};
  try {
    return study::read_plan(folder).file;
  } catch (const InputError&) {
    return {};
  }
}

fs::path study_folder(const StudyArguments& args, const study::Plan& plan) {
  const fs::path folder = args.out.empty() ? fs::path("runs") / plan.name : fs::path(args.out);
  if (!is_there(folder / study::kPlanFile) && is_there(folder / "run.lock"))
    throw InputError(
        fmt::format("{}: holds a single run (its results would be mixed with those of "
                    "the study). Choose another --out.",
                    folder.string()));
  if (const fs::path of = file_of_study(folder);
      !of.empty() && is_there(of) && !fs::equivalent(of, plan.file))
    print_warning(fmt::format(
        "{}: holds the study of {}: its table and report are replaced by those of {}, and what both "
        "have computed is kept. If they are two studies, give one another 'name' or --out.",
        folder.string(), of.string(), plan.file.string()));
  return fs::absolute(folder);
}

void expect_allowed(const study::Plan& plan, const std::vector<std::string>& allowed) {
  for (const std::string& program : plan.programs)
    if (std::find(allowed.begin(), allowed.end(), program) == allowed.end())
      throw InputError(fmt::format(
          "{}: a stage would start '{}' (a workflow file from somebody else could name any program). "
          "If you trust it, add --allow-python '{}'.",
          plan.file.string(), program, program));
}

int run_stage_of_study(const std::string& text) {
  study::run_job_aloud(study::job_from(text), all_stages(), &stop_on_signal(Again::ignored));
  return 0;
}

study::PoolOptions pool_options(const StudyArguments& args) {
  study::PoolOptions options = usual_pool_options();
  if (args.threads > 0) options.threads = static_cast<std::size_t>(args.threads);
  options.jobs = args.jobs > 0 ? static_cast<std::size_t>(args.jobs) : options.threads;
  options.retry = args.retry;
  options.allowed_programs = args.allowed_programs;
  return options;
}

StudyOutput output_of(const StudyArguments& args) {
  if (args.json) return StudyOutput::json;
  if (args.quiet) return StudyOutput::quiet;
  return ::isatty(STDOUT_FILENO) == 1 ? StudyOutput::terminal : StudyOutput::lines;
}

/// One process at a time: two jobs of a cluster may be told to at once.
study::Table write_results(const fs::path& folder, const study::Plan& plan,
                           const study::StudyState& progress) {
  study::Locks locks(folder);
  while (!locks.take(sha256("table and report"))) {
    if (stop_on_signal().load())
      throw Interrupted("stopped; the table is being written elsewhere.");
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  study::Table table = make_table(plan, progress);
  write_tables(folder, plan, table);
  write_page(folder, plan, table, &stop_on_signal());
  return table;
}

/// Exit code of a study as it was planned; nothing if a workflow was edited meanwhile.
std::optional<int> run_plan(const StudyArguments& args, const study::Plan& plan,
                            const study::SlurmSettings& slurm) {
  expect_allowed(plan, args.allowed_programs);
  const fs::path folder = study_folder(args, plan);
  const study::Store store(folder);
  study::StudyState progress(plan, store);
  StudyDisplay display(plan, progress, output_of(args));
  display.begin(folder);
  const bool local = args.executor == "local";
  if (!local && submit_study(plan, store, progress,
                             {.slurm = slurm,
                              .dry_run = args.dry_run,
                              .retry = args.retry,
                              .allowed_programs = args.allowed_programs,
                              .output = output_of(args)}))
    return 0;
  if (args.dry_run) {
    const study::PoolOptions pool = pool_options(args);
    display.plan({plan, progress, pool.costs, 1}, pool.jobs);
    return 0;
  }
  make_folders(folder / "stages");
  study::write_plan(folder, plan);
  const study::PoolOptions options = pool_options(args);
  study::SessionLog log(folder, this_session(options));
  study::PoolEnd end = study::PoolEnd::done;
  try {
    end = run_pool(plan, store, progress, options, logged(display.events(), log));
  } catch (...) {
    display.close();
    throw;
  }
  display.close();
  if (end == study::PoolEnd::outdated) return std::nullopt;
  display.end(folder, write_results(folder, plan, progress));
  const bool failed = std::any_of(plan.rows.begin(), plan.rows.end(), [&](const study::Row& row) {
    return progress.row_state(row) != study::State::done;
  });
  return failed ? kRowsFailed : 0;
}

int run_study(const StudyArguments& args) {
  validate(args.executor == "local" || (args.jobs == 0 && args.threads == 0),
           "--jobs and --threads are for this machine (a task of Slurm has the processors that the "
           "study file gives it). Write 'slurm: {{cpus: ...}}' there.");
  // A workflow that does not stay as it is for as long as it takes to plan is one that a program
  // writes over and over.
  constexpr int kMostPlans = 20;
  for (int i = 0; i < kMostPlans; ++i) {
    const study::StudyFile file = study::read_study(args.file);
    if (const auto code = run_plan(args, study::make_plan(file, all_stages()), file.slurm))
      return *code;
    fmt::print(stderr,
               "note: {}: a workflow, or a file that it names, has changed since the study was "
               "planned; it is planned again, and what did not change is kept\n",
               args.file);
  }
  throw InputError(
      fmt::format("{}: its workflows change again and again (rows would be of many versions). Run "
                  "the study when they stay as they are.",
                  args.file));
}

struct Opened {
  fs::path folder;
  study::Plan plan;
  study::Store store;
  study::StudyState progress;
  explicit Opened(const std::string& name)
      : folder(fs::absolute(name)),
        plan(study::read_plan(folder)),
        store(folder),
        progress(plan, store) {}
};

int status(const StudyArguments& args) {
  const Opened study(args.out);
  StudyDisplay(study.plan, study.progress, args.json ? StudyOutput::json : StudyOutput::lines)
      .status(study.folder, study::bytes_of(study.folder / "stages"), queue_of(study.folder));
  return 0;
}

int table(const StudyArguments& args) {
  const Opened study(args.out);
  fmt::print("{}", to_csv(make_table(study.plan, study.progress)));
  return 0;
}

/// What is missing of the whole page, and how it comes in.
void tell_missing(const study::WholePage& whole, const study::Plan& plan, const fs::path& folder) {
  if (!whole.not_done.empty())
    print_warning(
        fmt::format("{} of {} rows have no run in it because they are not done (rows {}). "
                    "Run the study again: flowslide study run {}",
                    whole.not_done.size(), plan.rows.size(), fmt::join(whole.not_done, ", "),
                    plan.file.string()));
  if (!whole.no_report.empty())
    print_warning(
        fmt::format("{} of {} rows have no run in it because their workflow has no stage "
                    "report.runout (rows {}). Add one to it",
                    whole.no_report.size(), plan.rows.size(), fmt::join(whole.no_report, ", ")));
  if (!whole.not_kept.empty())
    print_warning(fmt::format(
        "{} of {} rows have no run in it because its page was not kept (rows {}). Write 'keep: "
        "final' and a 'disk' that is large enough into {}, with 'page: true' for the report, take "
        "away the records of the reports without files (the .json without a folder of that name in "
        "the stage's folder in {}), and run the study: it computes these runs again",
        whole.not_kept.size(), plan.rows.size(), fmt::join(whole.not_kept, ", "),
        plan.file.string(), (folder / "stages").string()));
}

int report_whole(const StudyArguments& args, const Opened& study, const study::Table& table) {
  const study::WholeSize size{.states = static_cast<std::size_t>(args.frames)};
  const study::WholePage whole =
      write_whole_page(study.folder, study.plan, table, size, &stop_on_signal());
  const double bytes = static_cast<double>(whole.bytes);
  fmt::print("{} ({:.1f} MB, with the runs of {} of {} rows)\n", whole.path.string(), bytes / 1e6,
             whole.rows, study.plan.rows.size());
  tell_missing(whole, study.plan, study.folder);
  if (args.frames == 0 && whole.states < whole.all_states)
    fmt::print("players have up to {} of {} states, for {:.0f} MB at most; all: --frames {}\n",
               whole.states, whole.all_states, size.bytes / 1e6, whole.all_states);
  if (bytes > size.bytes)
    print_warning(
        fmt::format("{} is larger than {:.0f} MB (mail and some browsers do not take it). "
                    "Write it with fewer states of each player, --frames N; there are up "
                    "to {} now",
                    whole.path.filename().string(), size.bytes / 1e6, whole.states));
  return 0;
}

int report_study(const StudyArguments& args) {
  const Opened study(args.out);
  const study::Table table = write_results(study.folder, study.plan, study.progress);
  fmt::print("{}\n", (study.folder / "study.html").string());
  return args.whole ? report_whole(args, study, table) : 0;
}

int clean(const StudyArguments& args) {
  const Opened study(args.out);
  const study::Cleaned c = study::clean(study.plan, study.store, study.progress, args.dry_run);
  fmt::print("{} results that no row needs, {:.1f} MB{}\n", c.results, c.bytes / 1e6,
             args.dry_run ? " (would go)" : " taken away");
  if (c.in_use > 0) fmt::print("{} more are in use by another process\n", c.in_use);
  return 0;
}

using Arguments = std::shared_ptr<StudyArguments>;

CLI::App* add(CLI::App& study, Command& action, const std::string& name, const std::string& doc,
              const Arguments& args, int (*act)(const StudyArguments&)) {
  CLI::App* command = study.add_subcommand(name, doc);
  command->callback([args, act, &action] { action = [args, act] { return act(*args); }; });
  return command;
}

void add_study_run(CLI::App& study, Command& action) {
  const auto args = std::make_shared<StudyArguments>();
  CLI::App* command =
      add(study, action, "run", "Compute what is missing of a study", args, run_study);
  command->add_option("file", args->file, "study, FILE.yaml")->required()->check(input_name());
  command->add_option("--out", args->out, "folder of the study [runs/NAME]")->check(output_name());
  command->add_option("--jobs", args->jobs, "stages at once [one a processor]")
      ->check(CLI::Range(1, 4096));
  command->add_option("--threads", args->threads, "threads of all together [all]")
      ->check(CLI::Range(1, 4096));
  command->add_option("--allow-python", args->allowed_programs, "interpreter to be allowed")
      ->take_all()
      ->allow_extra_args(false);
  command->add_option("--executor", args->executor, "local, or slurm: send jobs [local]")
      ->check(CLI::IsMember({"local", "slurm"}));
  command->add_flag("--retry", args->retry, "also what has failed for good before");
  command->add_flag("--dry-run", args->dry_run, "only tell what would run");
  command->add_flag("--quiet", args->quiet, "only tell what failed");
  command->add_flag("--json", args->json, "one JSON object per line");
}

}  // namespace

void add_study(CLI::App& app, Command& action) {
  CLI::App* study = app.add_subcommand("study", "Many rows of a workflow, their table and report");
  study->require_subcommand(1);
  add_study_run(*study, action);
  const auto on_folder = [&](const char* name, const char* doc, int (*act)(const StudyArguments&)) {
    const auto args = std::make_shared<StudyArguments>();
    CLI::App* command = add(*study, action, name, doc, args, act);
    command->add_option("folder", args->out, "folder of the study, DIR")
        ->required()
        ->check(input_name());
    return std::pair{command, args};
  };
  const auto [status_command, status_args] = on_folder("status", "Tell how far a study is", status);
  status_command->add_flag("--json", status_args->json, "as JSON");
  on_folder("table", "Print the table of all rows as CSV", table);
  const auto [report_command, report_args] =
      on_folder("report", "Write tables, figures and page again", report_study);
  report_command->add_flag("--whole", report_args->whole,
                           "also study-whole.html, with all runs in it");
  report_command
      ->add_option("--frames", report_args->frames,
                   "states of each player in it, at most [for 60 MB]")
      ->check(CLI::Range(2, 1000))
      ->needs("--whole");
  const auto [clean_command, clean_args] =
      on_folder("clean", "Take away results that no row needs", clean);
  clean_command->add_flag("--dry-run", clean_args->dry_run, "only tell how much");

  const auto part = std::make_shared<std::pair<std::string, std::size_t>>();
  CLI::App* part_command =
      study->add_subcommand("part", "Compute what a task of a job array is to compute");
  part_command->add_option("file", part->first, "what the array is to compute, FILE.json")
      ->required()
      ->check(input_name());
  part_command->add_option("task", part->second, "number of the task, from 0")->required();
  part_command->callback(
      [part, &action] { action = [part] { return run_study_part(part->first, part->second); }; });

  // What `run` starts for each stage; of no use to people.
  const auto job = std::make_shared<std::string>();
  CLI::App* stage = study->add_subcommand("stage", "Compute one stage of a study")->group("");
  stage->add_option("job", *job, "the job")->required();
  stage->callback([job, &action] { action = [job] { return run_stage_of_study(*job); }; });
}

}  // namespace flowslide::cli
