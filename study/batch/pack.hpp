#pragma once
#include "study/plan/plan.hpp"

#include <cstddef>
#include <string>
#include <vector>

/// Stages of a study as tasks for a cluster, where each task waits for a processor, perhaps for
/// hours, and its nodes share nothing but files. docs/adr/0017-clusters.md
namespace flowslide::study {

/// Stages that one process computes on one machine.
struct ArrayTask {
  std::vector<std::size_t> nodes;  ///< those that feed others first
  double seconds = 0.0;            ///< that it is expected to take
};

/// Tasks that may all run at the same time, when those of the arrays before have ended.
struct JobArray {
  std::string name;  ///< "rows", of a file
  std::vector<ArrayTask> tasks;
};

struct Packing {
  double chunk = 1800.0;  ///< that a task is expected to take at least, as far as there is so
                          ///< much to do [s]
  std::size_t cpus = 1;   ///< of a task
  std::size_t most_tasks = 1000;  ///< of an array
};

/// Which stages go into which task, each open one into exactly one, so that no two tasks ever make
/// the same result. `open` and `seconds` (on one processor) are by node; a stage of which nothing
/// is known counts a minute.
std::vector<JobArray> pack(const Plan& plan, const std::vector<bool>& open,
                           const std::vector<double>& seconds, const Packing& packing);

}  // namespace flowslide::study
