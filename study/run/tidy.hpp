#pragma once
#include "study/run/locks.hpp"
#include "study/run/study_state.hpp"

#include <string>
#include <unordered_map>
#include <unordered_set>

namespace flowslide::study {

/// Takes the files away that the plan does not keep and that no stage still to run reads; above
/// plan.disk_bytes also others, first those that are made again most cheaply for their size. What
/// another process uses stays. The store is measured once, and then what each stage adds.
class Tidier {
 public:
  Tidier(const Plan& plan, const Store& store, Locks& locks);
  /// The files of a node are new: they are measured again.
  void made(const StudyState& progress, std::size_t node);
  /// Returns the bytes that the store takes afterwards, without what stages are writing.
  double tidy(const StudyState& progress);

 private:
  /// What is known of a result.
  struct Kept {
    std::string stage, key;
    double bytes = 0.0;   ///< of the files of its result
    double beside = 0.0;  ///< of what stays when these go
    double seconds = 0.0;
    bool has_frames = false;
  };
  [[nodiscard]] std::string name_of(const StudyState& progress, std::size_t node) const;
  void measure(const StudyState& progress);
  void drop(Kept& kept);

  const Plan& plan_;
  const Store& store_;
  Locks& locks_;
  double rest_ = 0.0;  ///< what is of no key of the plan
  bool first_ = true;
  std::unordered_map<std::string, Kept> kept_;  ///< by STAGE/KEY
  std::unordered_set<std::string> needed_;      ///< that stages still to run read or make
};

}  // namespace flowslide::study
