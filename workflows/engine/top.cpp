#include "workflows/engine/top.hpp"

#include "core/files.hpp"
#include "workflows/engine/publish.hpp"

#include <algorithm>

namespace fs = std::filesystem;

namespace flowslide {

RunTop::RunTop(const fs::path& run_folder, const Workflow& workflow, const RunEvents& events)
    : folder_(run_folder), events_(events) {
  LockRead read = read_lock(folder_);
  before_ = std::move(read.lock);
  if (!read.problem.empty())
    events_.notice(read.problem);
  else if (!before_ && is_there(folder_ / kResultFile))
    events_.notice("run.lock is missing");
  if (before_)
    for (const std::string& problem : problems_at_top(folder_, *before_)) events_.notice(problem);

  if (before_) lock_ = *before_;
  lock_.workflow = workflow.name;
  lock_.file = fs::absolute(workflow.file).string();
  lock_.overrides = workflow.overrides;
  std::erase_if(lock_.stages, [&](const auto& entry) {
    return std::none_of(workflow.stages.begin(), workflow.stages.end(),
                        [&](const WorkflowStage& s) { return s.name == entry.first; });
  });
}

std::optional<StageRecord> RunTop::previous(const std::string& stage) const {
  if (!before_) return std::nullopt;
  const auto it = before_->stages.find(stage);
  return it == before_->stages.end() ? std::nullopt : std::optional(it->second);
}

void RunTop::withdraw_earlier() {
  withdraw(folder_, before_);
  lock_.complete = false;
  lock_.published.clear();
  write_lock(folder_, lock_);
  withdrawn_ = true;
}

void RunTop::stage_runs() {
  if (withdrawn_) return;
  if (is_there(folder_ / kResultFile))
    events_.notice(
        fmt::format("{} of the earlier run goes until this one is complete; what it "
                    "computed stays in stages/",
                    kResultFile));
  withdraw_earlier();
}

void RunTop::stage_done(const StageRecord& record, bool ran) {
  StageRecord& entry = lock_.stages[record.stage] = record;
  entry.files.clear();
  if (ran) write_lock(folder_, lock_);
}

bool RunTop::stands_for(const std::vector<StageRecord>& records) const {
  return before_ && before_->complete && before_->stages.size() == records.size() &&
         before_->published == publications(records) &&
         std::all_of(records.begin(), records.end(), [&](const StageRecord& record) {
           const auto before = before_->stages.find(record.stage);
           return before != before_->stages.end() && before->second.key == record.key;
         });
}

void RunTop::finish(const std::vector<StageRecord>& records, const std::string& result) {
  const bool same = !withdrawn_ && stands_for(records);
  if (!same) {
    if (!withdrawn_) withdraw_earlier();
    lock_.published = publications(records);
    write_lock(folder_, lock_);  // first the names, so that a later run can withdraw them
  }
  for (const Publication& item : lock_.published) publish(folder_, item, same);
  for (const StageRecord& record : records) give(folder_, record, lock_, events_.notice);
  write_file(folder_ / kResultFile, result);
  lock_.complete = true;
  write_lock(folder_, lock_);
}

}  // namespace flowslide
