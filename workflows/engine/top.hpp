#pragma once
#include "workflows/engine/lock.hpp"
#include "workflows/engine/runner.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace flowslide {

/// The top of a run folder during one call of run_workflow. What an earlier workflow has put there
/// goes when the first stage has to run, not before; what this one puts there comes at the end.
/// While result.json is there, run.lock names the workflow to which it belongs.
class RunTop {
 public:
  /// Tells what is damaged or missing.
  RunTop(const std::filesystem::path& run_folder, const Workflow& workflow,
         const RunEvents& events);

  /// What the folder stood for before this call.
  [[nodiscard]] std::optional<StageRecord> previous(const std::string& stage) const;

  void stage_runs();
  void stage_done(const StageRecord& record, bool ran);
  void finish(const std::vector<StageRecord>& records, const std::string& result);

 private:
  void withdraw_earlier();
  [[nodiscard]] bool stands_for(const std::vector<StageRecord>& records) const;

  std::filesystem::path folder_;
  const RunEvents& events_;
  std::optional<RunLock> before_;
  RunLock lock_;
  bool withdrawn_ = false;
};

}  // namespace flowslide
