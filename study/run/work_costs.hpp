#pragma once
#include "study/plan/plan.hpp"
#include "study/run/study_state.hpp"
#include "workflows/engine/cost_book.hpp"

#include <filesystem>
#include <vector>

namespace flowslide::study {

/// What the stages of a study are expected to take: the model of single runs, which learns as they
/// end.
class WorkCosts {
 public:
  /// Learns from what is finished. `threads`: of a stage, as a rule; `file` as for CostBook.
  WorkCosts(const Plan& plan, const StudyState& progress, std::filesystem::path file, int threads);
  void learn(std::size_t node, const Finished& finished, int threads);
  /// [s]; NaN if nothing is known.
  [[nodiscard]] double seconds(std::size_t node) const { return expected_[node].seconds; }
  /// [bytes]; a usual value where nothing is known.
  [[nodiscard]] double memory(std::size_t node) const;
  void keep() { book_.keep(); }

 private:
  void expect_all();

  CostBook book_;
  int threads_;
  std::vector<Task> tasks_;     ///< by node
  std::vector<Cost> expected_;  ///< by node; asked for ten times a second
};

}  // namespace flowslide::study
