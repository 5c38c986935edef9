#pragma once
#include "study/run/store.hpp"

#include <atomic>
#include <functional>
#include <span>
#include <string>
#include <string_view>

/// One stage of a row, as a process of its own computes it.
namespace flowslide::study {

struct Job {
  std::filesystem::path store;
  std::filesystem::path workflow;
  std::vector<std::string> overrides;
  std::string stage;
  std::string key;  ///< that the stage must have
  int threads = 1;
  bool final_state = true;  ///< write that of a runout beside its result
  std::vector<std::string> allowed_programs;
};

std::string to_text(const Job& job);
/// InputError for what is no job.
Job job_from(const std::string& text);

enum class JobEnd {
  made,
  found,    ///< another process was faster
  busy,     ///< another process is at it
  damaged,  ///< the files of an input are not what they were
  changed,  ///< the workflow, or a file it names, is no longer that of the plan
};

struct JobResult {
  JobEnd end = JobEnd::made;
  std::string stage;  ///< damaged: whose files
};

using Report = std::function<void(double fraction, std::string_view text)>;

/// Computes the stage from the results of those before it, and writes what it found beside the
/// result. Throws what stages throw, and FileError.
JobResult run_job(const Job& job, std::span<const StageType> types, const std::atomic<bool>* stop,
                  const Report& report);

/// run_job with its progress and end as lines on standard output, for the process that waits.
JobResult run_job_aloud(const Job& job, std::span<const StageType> types,
                        const std::atomic<bool>* stop);

}  // namespace flowslide::study
