#include "study/batch/submit.hpp"

#include "core/files.hpp"
#include "study/run/work_costs.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <functional>

namespace fs = std::filesystem;

namespace flowslide::study {
namespace {

constexpr std::string_view kRecordEnding = ".json";

/// DIR/slurm/3 for the next one to be sent.
fs::path next_folder(const fs::path& all) {
  unsigned last = 0;
  // A folder that cannot be listed is an error: jobs in the queue have their scripts in it.
  if (!is_there(all)) return all / "1";
  for (const auto& entry : fs::directory_iterator(all)) {
    const std::string name = entry.path().filename().string();
    unsigned number = 0;
    const auto [end, problem] = std::from_chars(name.data(), name.data() + name.size(), number);
    if (problem == std::errc() && end == name.data() + name.size()) last = std::max(last, number);
  }
  return all / std::to_string(last + 1);
}

/// Nodes that have to be computed and are in no queue: what is not done, and what is but without
/// the files that such a stage reads.
std::vector<bool> open_nodes(const Plan& plan, const Store& store, const StudyState& progress,
                             const UnderWay& under_way) {
  std::vector<bool> open(plan.nodes.size());
  for (std::size_t n = plan.nodes.size(); n-- > 0;) {
    const State state = progress.node(n).state;
    open[n] = (open[n] || state == State::ready || state == State::waiting) &&
              !under_way.jobs.contains(plan.nodes[n].recipe);
    if (!open[n]) continue;
    for (const std::size_t from : plan.nodes[n].reads()) {
      const NodeState& read = progress.node(from);
      if (read.state == State::done && !store.has_files(plan.nodes[from].stage.name, read.key))
        open[from] = true;
    }
  }
  return open;
}

/// Jobs that make what open stages read.
std::vector<std::string> jobs_before(const Plan& plan, const std::vector<bool>& open,
                                     const UnderWay& under_way) {
  std::set<std::string> jobs;
  for (std::size_t n = 0; n < plan.nodes.size(); ++n)
    if (open[n])
      for (const std::size_t from : plan.nodes[n].before)
        if (const auto job = under_way.jobs.find(plan.nodes[from].recipe);
            job != under_way.jobs.end())
          jobs.insert(job->second);
  return {jobs.begin(), jobs.end()};
}

/// Of as many stages side by side as a task has processors, and of the program that starts them.
double memory_of(const JobArray& array, const WorkCosts& costs, std::size_t cpus) {
  constexpr double kProgram = 200e6, kStep = 100.0 * 1024.0 * 1024.0;
  double most = 0.0;
  for (const ArrayTask& task : array.tasks) {
    std::vector<double> memory;
    for (const std::size_t n : task.nodes) memory.push_back(costs.memory(n));
    std::sort(memory.begin(), memory.end(), std::greater<>());
    double sum = 0.0;
    for (std::size_t i = 0; i < std::min(cpus, memory.size()); ++i) sum += memory[i];
    most = std::max(most, sum);
  }
  return std::ceil((most + kProgram) / kStep) * kStep;
}

double longest(const JobArray& array) {
  double seconds = 0.0;
  for (const ArrayTask& task : array.tasks) seconds = std::max(seconds, task.seconds);
  return seconds;
}

/// Three times what is expected, in steps of ten minutes, an hour at least.
double limit_of(const JobArray& array) {
  constexpr double kTimes = 3.0, kStep = 600.0, kLeast = 3600.0;
  return std::max(kLeast, std::ceil(kTimes * longest(array) / kStep) * kStep);
}

/// "40 s", "35 to 37 min", "2.5 h"
std::string duration_text(double least, double most) {
  constexpr double kMinute = 60.0, kHour = 3600.0;
  const auto text = [&](double unit, int digits, const char* name) {
    const std::string from = fmt::format("{:.{}f}", least / unit, digits);
    const std::string to = fmt::format("{:.{}f}", most / unit, digits);
    return fmt::format("{}{} {}", from == to ? "" : from + " to ", to, name);
  };
  if (most < 1.5 * kMinute) return text(1.0, most < 1.0 ? 1 : 0, "s");
  return most < 1.5 * kHour ? text(kMinute, 0, "min") : text(kHour, 1, "h");
}

/// Takes from the front what takes less than a minute, and next to nothing beside a chunk.
std::vector<bool> take_small(std::vector<JobArray>& arrays, const Packing& packing,
                             std::size_t nodes) {
  constexpr double kSeconds = 60.0, kShare = 1.0 / 30.0;
  std::vector<bool> small;
  double left = std::min(kSeconds, kShare * packing.chunk);
  while (arrays.size() > 1) {
    for (const ArrayTask& task : arrays.front().tasks)
      left -= task.seconds * static_cast<double>(packing.cpus);
    if (left < 0.0) break;
    small.resize(nodes);
    for (const ArrayTask& task : arrays.front().tasks)
      for (const std::size_t n : task.nodes) small[n] = true;
    arrays.erase(arrays.begin());
  }
  return small;
}

std::string about(const Plan& plan, const JobArray& array) {
  std::size_t stages = 0;
  double least = longest(array);
  for (const ArrayTask& task : array.tasks) {
    stages += task.nodes.size();
    least = std::min(least, task.seconds);
  }
  const std::string range = duration_text(least, longest(array));
  const std::string tasks = array.tasks.size() == 1
                                ? fmt::format("one task of {}", range)
                                : fmt::format("{} tasks of {} each", array.tasks.size(), range);
  return fmt::format("Study {}, {}: {} stage{}, expected to be {}.", plan.name,
                     array.name == "rows" ? "rows" : "what rows share", stages,
                     stages == 1 ? "" : "s", tasks);
}

/// A path stands in scripts that have lines.
void expect_one_line(const fs::path& path) {
  const std::string text = path.string();
  validate(std::none_of(text.begin(), text.end(), [](unsigned char c) { return std::iscntrl(c); }),
           "the path of the study, of the program or of this folder has a control character (a job "
           "script has one line for it). Rename it.");
}

Script script_of(const Plan& plan, const Batch& batch, const BatchOptions& options) {
  return {.name = {},
          .study = plan.name,
          .about = {},
          .folder = batch.folder,
          .directory = options.directory,
          .command = {options.program.string(), "study"}};
}

Script report_script(const Plan& plan, const Batch& batch, const Store& store,
                     const BatchOptions& options) {
  Script report = script_of(plan, batch, options);
  report.name = "report";
  report.about = fmt::format(
      "Study {}: table and report of all rows, when the jobs before have ended.", plan.name);
  report.command.insert(report.command.end(), {"report", store.folder().string()});
  report.resumes = false;
  report.memory = 1024.0 * 1024.0 * 1024.0;
  return report;
}

void add_array(Batch& batch, const Plan& plan, const JobArray& array, const WorkCosts& costs,
               const BatchOptions& options) {
  Script script = script_of(plan, batch, options);
  script.name = array.name;
  script.about = about(plan, array);
  script.command.insert(
      script.command.end(),
      {"part", (batch.folder / (array.name + std::string(kRecordEnding))).string()});
  script.tasks = array.tasks.size();
  if (script.tasks == 1) script.command.emplace_back("0");
  script.cpus = options.packing.cpus;
  script.memory = is_set(options.memory) ? options.memory : memory_of(array, costs, script.cpus);
  script.seconds = is_set(options.time) ? options.time : limit_of(array);
  ArrayRecord record{.cpus = script.cpus,
                     .memory = script.memory,
                     .retry = options.retry,
                     .allowed_programs = options.allowed_programs,
                     .tasks = {}};
  for (const ArrayTask& task : array.tasks) {
    auto& recipes = record.tasks.emplace_back();
    for (const std::size_t n : task.nodes) recipes.push_back(plan.nodes[n].recipe);
    batch.stages += task.nodes.size();
  }
  batch.scripts.push_back(std::move(script));
  batch.records.push_back(std::move(record));
}

fs::path file_of(const Script& script, std::string_view ending) {
  return script.folder / (script.name + std::string(ending));
}

}  // namespace

UnderWay under_way(const fs::path& study, const Scheduler& scheduler,
                   const std::vector<QueuedTask>& queue) {
  UnderWay result;
  const fs::path all = fs::weakly_canonical(study / scheduler.name);
  std::map<fs::path, ArrayRecord> records;
  for (const QueuedTask& task : queue) {
    // Scripts of other jobs may lie where nobody can look from here.
    std::error_code error;
    const fs::path script = fs::weakly_canonical(task.script, error);
    if (error || script.parent_path().parent_path() != all) continue;
    fs::path file = script;
    file.replace_extension(kRecordEnding);
    // The job of the report has none.
    if (!is_there(file)) continue;
    if (!records.contains(file)) records[file] = read_array(file);
    const auto& tasks = records[file].tasks;
    if (task.task >= tasks.size()) continue;
    (task.ending ? result.ending : task.running ? result.running : result.waiting) += 1;
    for (const std::string& recipe : tasks[task.task]) result.jobs[recipe] = task.job;
  }
  return result;
}

Batch plan_batch(const Plan& plan, const Store& store, StudyState& progress,
                 const UnderWay& under_way, const Scheduler& scheduler,
                 const BatchOptions& options) {
  for (const fs::path& path : {store.folder(), options.program, options.directory})
    expect_one_line(path);
  progress.reopen(options.retry ? Retry::all : Retry::passing);
  const std::vector<bool> open = open_nodes(plan, store, progress, under_way);
  const WorkCosts costs(plan, progress, options.costs, 1);
  std::vector<double> seconds;
  for (std::size_t n = 0; n < plan.nodes.size(); ++n) seconds.push_back(costs.seconds(n));
  Batch batch{.folder = next_folder(store.folder() / scheduler.name),
              .scripts = {},
              .records = {},
              .after = jobs_before(plan, open, under_way),
              .here = {}};
  std::vector<JobArray> arrays = pack(plan, open, seconds, options.packing);
  batch.here = take_small(arrays, options.packing, plan.nodes.size());
  for (const JobArray& array : arrays) add_array(batch, plan, array, costs, options);
  if (!batch.scripts.empty()) batch.scripts.push_back(report_script(plan, batch, store, options));
  return batch;
}

std::vector<std::string> send(const Batch& batch, const Scheduler& scheduler) {
  std::vector<std::string> texts;
  for (const Script& script : batch.scripts) texts.push_back(scheduler.text(script));
  make_folders(batch.folder);
  for (std::size_t i = 0; i < batch.scripts.size(); ++i) {
    const Script& script = batch.scripts[i];
    if (i < batch.records.size()) write_array(file_of(script, kRecordEnding), batch.records[i]);
    write_file(file_of(script, scheduler.ending), texts[i]);
  }
  std::vector<std::string> jobs, after = batch.after;
  for (const Script& script : batch.scripts) {
    jobs.push_back(scheduler.send(script, after));
    after = {jobs.back()};
  }
  return jobs;
}

std::string commands(const Batch& batch, const Scheduler& scheduler) {
  std::string text;
  for (const Script& script : batch.scripts)
    text += fmt::format("==> {} <==\n{}\n", file_of(script, scheduler.ending).string(),
                        scheduler.text(script));
  return text + scheduler.commands(batch.scripts, batch.after);
}

}  // namespace flowslide::study
