#pragma once
#include "study/batch/scheduler.hpp"
#include "study/plan/study_file.hpp"

#include <string_view>

namespace flowslide::study {

/// `stop` ends the waiting for commands of Slurm with Interrupted.
Scheduler slurm(const SlurmSettings& settings, const std::atomic<bool>* stop);

/// A word of a shell, quoted where it has to be.
std::string shell_word(const std::string& text);
/// A word behind #SBATCH, which sbatch itself takes apart.
std::string sbatch_word(const std::string& text);
/// "1-06:30:00", rounded up to whole minutes.
std::string slurm_time(double seconds);
/// Lines of 'squeue --array --noheader --format=%F|%K|%t|%o'.
std::vector<QueuedTask> queued_tasks(std::string_view lines);

}  // namespace flowslide::study
