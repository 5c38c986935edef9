#include "cli/study_batch.hpp"

#include "cli/signals.hpp"
#include "cli/study_pool.hpp"
#include "core/check.hpp"
#include "core/files.hpp"
#include "core/hash.hpp"
#include "core/memory.hpp"
#include "study/batch/slurm.hpp"
#include "study/batch/submit.hpp"
#include "study/run/locks.hpp"
#include "workflows/engine/cost_book.hpp"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <set>
#include <thread>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace fs = std::filesystem;

namespace flowslide::cli {
namespace {

using Json = nlohmann::ordered_json;

std::string counted(std::size_t count, const char* what) {
  return fmt::format("{} {}{}", count, what, count == 1 ? "" : "s");
}

/// "2 tasks run, 1 waits (squeue --me)"
std::string queue_words(const study::UnderWay& found, const study::Scheduler& scheduler) {
  return fmt::format("{} run{}, {} wait{} ({})", counted(found.running + found.ending, "task"),
                     found.running + found.ending == 1 ? "s" : "", found.waiting,
                     found.waiting == 1 ? "s" : "", scheduler.follow);
}

void print_note(const std::string& text) { fmt::print(stderr, "note: {}\n", text); }

/// What waits or runs already. What Slurm is about to end is waited for: its stages are missing,
/// but until it has ended nobody else may make them.
study::UnderWay look_at_queue(const fs::path& folder, const study::Scheduler& scheduler) {
  constexpr int kMostSeconds = 120;
  for (int i = 0;; ++i) {
    study::UnderWay found = under_way(folder, scheduler, scheduler.queue());
    if (found.ending == 0 || i == kMostSeconds) return found;
    if (i == 0)
      print_note(fmt::format("waiting for the end of {} that Slurm is ending",
                             counted(found.ending, "task")));
    if (stop_on_signal().load()) throw Interrupted("stopped; nothing has been sent.");
    std::this_thread::sleep_for(std::chrono::seconds(1));
  }
}

study::BatchOptions batch_options(const SubmitOptions& options) {
  return {.packing = {.chunk = options.slurm.chunk, .cpus = options.slurm.cpus},
          .memory = options.slurm.memory,
          .time = options.slurm.time,
          .retry = options.retry,
          .allowed_programs = options.allowed_programs,
          .costs = usual_cost_file(),
          .program = fs::read_symlink("/proc/self/exe"),
          .directory = fs::current_path()};
}

void tell_under_way(const study::UnderWay& found, const study::Scheduler& scheduler) {
  fmt::print("{} wait{} or run{} already: {}\n", counted(found.jobs.size(), "stage"),
             found.jobs.size() == 1 ? "s" : "", found.jobs.size() == 1 ? "s" : "",
             queue_words(found, scheduler));
}

void tell_sent(const study::Batch& batch, const std::vector<std::string>& jobs,
               const study::Scheduler& scheduler, const study::Store& store, StudyOutput output) {
  if (output == StudyOutput::json) {
    Json list = Json::array();
    for (std::size_t i = 0; i < jobs.size(); ++i)
      list.push_back(
          {{"name", batch.scripts[i].name}, {"job", jobs[i]}, {"tasks", batch.scripts[i].tasks}});
    fmt::print("{}\n", Json({{"event", "sent"},
                             {"stages", batch.stages},
                             {"folder", batch.folder.string()},
                             {"jobs", list}})
                           .dump(-1, ' ', false, Json::error_handler_t::replace));
    return;
  }
  if (output == StudyOutput::quiet) return;
  for (std::size_t i = 0; i < jobs.size(); ++i)
    fmt::print("{:<24} job {}, {}\n", batch.scripts[i].name, jobs[i],
               counted(batch.scripts[i].tasks, "task"));
  fmt::print("{:<24} {}\n{:<24} flowslide study status {}, {}\n", "scripts and logs",
             batch.folder.string(), "how it goes", study::shell_word(store.folder().string()),
             scheduler.follow);
}

std::set<std::string> names_of(const study::Plan& plan, const std::vector<bool>& nodes) {
  std::set<std::string> names;
  for (std::size_t n = 0; n < nodes.size(); ++n)
    if (nodes[n]) names.insert(plan.nodes[n].stage.name);
  return names;
}

study::PoolEnd run_nodes(const study::Plan& plan, const study::Store& store,
                         study::StudyState& progress, const study::PoolOptions& options,
                         StudyOutput output) {
  StudyDisplay display(plan, progress, output);
  study::SessionLog log(store.folder(), this_session(options));
  const study::PoolEnd end =
      run_pool(plan, store, progress, options, logged(display.events(), log));
  display.close();
  return end;
}

void expect_current(study::PoolEnd end) {
  if (end == study::PoolEnd::outdated)
    throw InputError(
        "a workflow, or a file that it names, has changed since the study was planned (results would "
        "be of two versions). Run 'flowslide study run' again.");
}

bool show(const study::Plan& plan, const study::Store& store, study::StudyState& progress,
          const study::Scheduler& scheduler, const SubmitOptions& options) {
  study::UnderWay found;
  try {
    found = look_at_queue(store.folder(), scheduler);
  } catch (const FileError& e) {
    print_note(fmt::format("what waits or runs already is not left out here: {}", e.what()));
  }
  const study::Batch batch =
      plan_batch(plan, store, progress, found, scheduler, batch_options(options));
  if (!found.jobs.empty()) tell_under_way(found, scheduler);
  if (batch.scripts.empty()) return !found.jobs.empty();
  if (!batch.here.empty())
    fmt::print("here, before the jobs:   {}\n", fmt::join(names_of(plan, batch.here), ", "));
  fmt::print("\n{}", commands(batch, scheduler));
  return true;
}

}  // namespace

bool submit_study(const study::Plan& plan, const study::Store& store, study::StudyState& progress,
                  const SubmitOptions& options) {
  const study::Scheduler scheduler = study::slurm(options.slurm, &stop_on_signal());
  if (options.dry_run) return show(plan, store, progress, scheduler, options);
  make_folders(store.folder() / "stages");
  study::Locks locks(store.folder());
  if (!locks.take(sha256("jobs are being sent")))
    throw InputError(fmt::format(
        "{}: another process is sending jobs of this study (the same work would be sent twice). Wait "
        "until it has ended.",
        store.folder().string()));
  study::write_plan(store.folder(), plan);
  const study::UnderWay found = look_at_queue(store.folder(), scheduler);
  const study::BatchOptions how = batch_options(options);
  study::Batch batch = plan_batch(plan, store, progress, found, scheduler, how);
  if (!batch.here.empty()) {
    study::PoolOptions pool = usual_pool_options();
    pool.only = batch.here;
    pool.allowed_programs = options.allowed_programs;
    expect_current(run_nodes(plan, store, progress, pool, options.output));
    batch = plan_batch(plan, store, progress, found, scheduler, how);
  }
  const bool told = options.output != StudyOutput::json && options.output != StudyOutput::quiet;
  if (told && !found.jobs.empty()) tell_under_way(found, scheduler);
  if (batch.scripts.empty()) return !found.jobs.empty();
  tell_sent(batch, send(batch, scheduler), scheduler, store, options.output);
  return true;
}

int run_study_part(const std::string& file, std::size_t task) {
  const study::ArrayRecord record = study::read_array(file);
  const fs::path folder = fs::absolute(file).parent_path().parent_path().parent_path();
  const study::Plan plan = study::read_plan(folder);
  const study::Store store(folder);
  study::StudyState progress(plan, store);
  study::PoolOptions options = usual_pool_options();
  options.jobs = options.threads = record.cpus;
  constexpr double kProgram = 200e6;
  options.memory = std::min(options.memory, record.memory - kProgram);
  options.retry = record.retry;
  options.allowed_programs = record.allowed_programs;
  options.only = nodes_of_task(plan, record, task);
  options.patience = 60.0;  // as long as NFS may remember that a file was not there
  const auto mine = [&](study::State state) {
    std::size_t count = 0;
    for (std::size_t n = 0; n < plan.nodes.size(); ++n)
      count += options.only[n] && progress.node(n).state == state;
    return count;
  };
  expect_current(run_nodes(plan, store, progress, options, StudyOutput::lines));
  const std::size_t all = record.tasks[task].size(), done = mine(study::State::done);
  fmt::print("task {}: {} of {} stages done, {} failed\n", task, done, all,
             mine(study::State::failed));
  return done == all ? 0 : 1;
}

std::optional<StudyQueue> queue_of(const fs::path& folder) {
  const study::Scheduler scheduler = study::slurm({}, &stop_on_signal());
  if (!is_there(folder / scheduler.name)) return std::nullopt;
  try {
    const study::UnderWay found = under_way(folder, scheduler, scheduler.queue());
    if (found.jobs.empty()) return std::nullopt;
    return StudyQueue{queue_words(found, scheduler), found.running, found.ending, found.waiting};
  } catch (const std::exception&) {
    return std::nullopt;  // this machine may not be of the cluster
  }
}

}  // namespace flowslide::cli
