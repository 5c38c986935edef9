#include "study/run/work_costs.hpp"

#include <algorithm>

namespace flowslide::study {

void WorkCosts::learn(const std::string& uses, const Finished& finished) {
  Kind& kind = kinds_[uses];
  kind.seconds += finished.record.seconds;
  kind.count += 1.0;
  kind.memory = std::max(kind.memory, finished.peak_memory);
}

void WorkCosts::guess(const std::string& uses, double seconds) { kinds_[uses].guessed = seconds; }

double WorkCosts::seconds(const std::string& uses) const {
  const auto it = kinds_.find(uses);
  if (it == kinds_.end()) return kUnset;
  return it->second.count > 0.0 ? it->second.seconds / it->second.count : it->second.guessed;
}

double WorkCosts::memory(const std::string& uses) const {
  constexpr double kUsual = 300e6;
  const auto it = kinds_.find(uses);
  return it == kinds_.end() || it->second.memory == 0.0 ? kUsual : it->second.memory;
}

}  // namespace flowslide::study
