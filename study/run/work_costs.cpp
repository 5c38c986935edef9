#include "study/run/work_costs.hpp"

#include <algorithm>

namespace flowslide::study {

WorkCosts::WorkCosts(const Plan& plan, const StudyState& progress, std::filesystem::path file,
                     int threads)
    : book_(std::move(file)), threads_(std::max(1, threads)) {
  for (std::size_t n = 0; n < plan.nodes.size(); ++n) {
    const Workflow workflow = workflow_of(plan, n);
    tasks_.push_back(task_of(workflow, workflow.stages.size() - 1));
    if (const auto& finished = progress.node(n).finished)
      book_.recall(tasks_[n], threads_, finished->record.seconds, finished->peak_memory);
  }
  expect_all();
}

void WorkCosts::expect_all() {
  expected_.clear();
  for (const Task& task : tasks_) expected_.push_back(book_.expect(task, threads_));
}

void WorkCosts::learn(std::size_t node, const Finished& finished, int threads) {
  book_.learn(tasks_[node], threads, finished.record.seconds, finished.peak_memory);
  expect_all();
}

double WorkCosts::memory(std::size_t node) const {
  constexpr double kUsual = 300e6, kMargin = 1.2;
  const double expected = expected_[node].memory;
  return is_set(expected) ? kMargin * expected : kUsual;
}

}  // namespace flowslide::study
