#pragma once
#include "study/plan/study_file.hpp"

#include <string>
#include <vector>

namespace flowslide::study {

/// A row of the study before its workflow is looked at.
struct Draft {
  const Part* part = nullptr;
  Settings values;  ///< label of each variable by its name
  Settings set;     ///< what the row sets in the workflow, in order
  std::vector<std::string> places;  ///< where each entry of `set` was written
  std::size_t repeat = 0;           ///< realisation
};

/// All rows: parts in their order, every value of a variable with every value of the others (the
/// first variable changes slowest), each of these with every sampled point, and its repeats.
std::vector<Draft> expand(const StudyFile& study);

}  // namespace flowslide::study
