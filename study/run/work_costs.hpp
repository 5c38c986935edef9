#pragma once
#include "study/run/study_state.hpp"

#include <map>
#include <string>

namespace flowslide::study {

/// What stages of a kind have taken so far, and what is to be expected of the next.
class WorkCosts {
 public:
  void learn(const std::string& uses, const Finished& finished);
  /// A running stage tells about its kind where none has ended yet.
  void guess(const std::string& uses, double seconds);
  /// [s]; NaN if nothing is known.
  [[nodiscard]] double seconds(const std::string& uses) const;
  /// [bytes], the largest seen; a usual value before.
  [[nodiscard]] double memory(const std::string& uses) const;

 private:
  struct Kind {
    double seconds = 0.0, count = 0.0, memory = 0.0, guessed = kUnset;
  };
  std::map<std::string, Kind> kinds_;
};

}  // namespace flowslide::study
