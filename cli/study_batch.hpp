#pragma once
#include "cli/study_display.hpp"
#include "study/plan/study_file.hpp"
#include "study/run/store.hpp"

#include <optional>

namespace flowslide::cli {

struct SubmitOptions {
  study::SlurmSettings slurm;
  bool dry_run = false, retry = false;
  std::vector<std::string> allowed_programs;
  StudyOutput output = StudyOutput::lines;
};

/// Sends what is missing of a study to Slurm, or prints what would be sent. False if nothing is
/// missing and nothing under way, so that the study only has to be finished here.
bool submit_study(const study::Plan& plan, const study::Store& store, study::StudyState& progress,
                  const SubmitOptions& options);

/// What a task of a job array does; its exit code.
int run_study_part(const std::string& file, std::size_t task);

/// None where the study was never sent, nothing is under way, or there is no telling.
std::optional<StudyQueue> queue_of(const std::filesystem::path& folder);

}  // namespace flowslide::cli
