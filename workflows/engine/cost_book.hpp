#pragma once
#include "workflows/engine/costs.hpp"

#include <filesystem>
#include <map>
#include <string>

namespace flowslide {

/// $XDG_CACHE_HOME/flowslide/costs-MACHINE.json, ~/.cache in place of the variable; empty where
/// there is no home. A home folder may be shared by machines of different speed.
std::filesystem::path usual_cost_file();

/// Name of this machine in letters, digits, '-' and '_'.
std::string machine_name();

/// A CostTable with the file that keeps it. A file that is missing, damaged or cannot be written
/// costs estimates and nothing else: nothing here throws. Processes may share it: it is replaced as
/// a whole, by what it held a moment before and what is new.
class CostBook {
 public:
  /// An empty path: nothing is read or kept.
  explicit CostBook(std::filesystem::path file = {});

  [[nodiscard]] Cost expect(const Task& task, int threads) const {
    return table_.expect(task, threads);
  }
  /// Goes into the file: at once if the stage took so long that writing costs nothing beside it.
  void learn(const Task& task, int threads, double seconds, double memory);
  /// What has been learnt before, perhaps elsewhere: for this process only.
  void recall(const Task& task, int threads, double seconds, double memory);
  void keep() noexcept;

 private:
  std::filesystem::path file_;
  CostTable table_;
  std::vector<CostRecord> fresh_;  ///< not yet in the file
};

/// Largest memory of this process so far [bytes].
double peak_memory();

/// User and system time of this process and of those that it has waited for [s].
double processor_time();

/// Wall time that work would have taken with its processors for itself [s]: other programs stretch
/// the wall time, and hardly the processor time.
double quiet_seconds(const Work& work, int threads, double wall, double processor);

}  // namespace flowslide
