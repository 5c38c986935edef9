#pragma once
#include "study/batch/part.hpp"
#include "study/batch/scheduler.hpp"

#include <map>
#include <set>

/// What is missing of a study as jobs of a scheduler: scripts and records in DIR/SCHEDULER/1, 2,
/// ...
namespace flowslide::study {

struct BatchOptions {
  Packing packing;
  double memory = kUnset;  ///< of a task [bytes]; unset: what its stages are expected to take
  double time = kUnset;    ///< limit of a task [s]; unset: generous against what is expected
  bool retry = false;
  std::vector<std::string> allowed_programs;
  std::filesystem::path costs = {};  ///< as for CostBook
  std::filesystem::path program;     ///< absolute, as the machines of the cluster see it
  std::filesystem::path directory;   ///< absolute; that relative paths of the study start from
};

/// What of a study waits or runs.
struct UnderWay {
  std::map<std::string, std::string> jobs;           ///< by recipe of a node
  std::size_t waiting = 0, running = 0, ending = 0;  ///< tasks
};

/// Those entries of a queue that are of this study, told by their scripts. Throws FileError and
/// std::filesystem::filesystem_error.
UnderWay under_way(const std::filesystem::path& study, const Scheduler& scheduler,
                   const std::vector<QueuedTask>& queue);

/// Arrays in the order in which they are sent, each to begin when all before it have ended, and
/// last the job that writes table and report.
struct Batch {
  std::filesystem::path folder;  ///< absolute
  std::vector<Script> scripts;
  std::vector<ArrayRecord> records;  ///< of the scripts but the last
  std::vector<std::string> after;    ///< jobs under way that make what these read
  std::size_t stages = 0;
  /// Nodes to be computed by whoever sends the rest, before: what rows share and takes less
  /// than a minute is not worth a job for which they all would wait. Empty if there are none.
  std::vector<bool> here;
};

/// Without scripts if nothing is left to be sent. Opens failures of `progress` again that are to be
/// tried again.
Batch plan_batch(const Plan& plan, const Store& store, StudyState& progress,
                 const UnderWay& under_way, const Scheduler& scheduler,
                 const BatchOptions& options);

/// Writes scripts and records and sends them; the numbers of the jobs. Throws FileError.
std::vector<std::string> send(const Batch& batch, const Scheduler& scheduler);

/// What `send` would do, with the scripts in full, as a person would do it.
std::string commands(const Batch& batch, const Scheduler& scheduler);

}  // namespace flowslide::study
