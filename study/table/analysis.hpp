#pragma once
#include "study/statistics/bootstrap.hpp"
#include "study/statistics/effects.hpp"
#include "study/statistics/least_squares.hpp"
#include "study/statistics/repeats.hpp"
#include "study/statistics/summary.hpp"
#include "study/statistics/threshold.hpp"
#include "study/table/table.hpp"

#include <atomic>
#include <map>
#include <string>
#include <vector>

namespace flowslide::study {

/// A number of the study and what it hangs on; x and y are columns of the table.
struct Relation {
  std::string x, y;
  Estimate spearman;
  /// Among rows that share the inputs `by`, which y hangs on beside x; not set without such inputs.
  Estimate within;
  std::string by;  ///< "c_soft"; several with ", "
  Line line;
};

struct Swing {
  std::string input, result;
  Effect effect;
};

/// Of the rows that share the inputs which y hangs on beside x, where there are enough of them:
/// each strength has a curve of its own.
struct Threshold {
  std::string x, y;
  std::string by;       ///< the first of those inputs; empty: all rows
  std::string where;    ///< "c_soft 0.5"; empty: all rows
  std::size_t row = 0;  ///< one of them
  Ramp ramp;
};

/// Rows of the main variant over those of another that agree in all inputs both have.
struct Comparison {
  std::string variant, result;
  std::string where;  ///< "c_soft 0.5"; empty: all
  Estimate ratio;
};

/// A variant that has no row to be compared with, and why.
struct NotCompared {
  std::string variant, result, why;
};

/// What a study says, over the means of its repeats. docs/theory/study-statistics.md
struct StudyFindings {
  std::string variant;               ///< whose rows these are, but for the comparisons
  std::vector<std::string> results;  ///< columns
  std::vector<Scatter> scatter;      ///< of each result, over all variants
  Repeats repeats;                   ///< of the rows of the table
  std::vector<std::size_t> groups;   ///< those of the variant: indices into repeats.groups
  std::vector<Relation> relations;
  std::vector<Swing> swings;
  std::vector<Threshold> thresholds;
  std::vector<Exceedance> exceedance;  ///< of each result
  std::vector<Comparison> comparisons;
  std::vector<NotCompared> not_compared;
};

/// Throws Interrupted once `stop` is set.
StudyFindings analyse(const Plan& plan, const Table& table,
                      const std::atomic<bool>* stop = nullptr);

/// Everything as JSON, numbers that are not known as null. `figures` are digests by file name.
std::string to_json_text(const Plan& plan, const StudyFindings& findings,
                         const std::map<std::string, std::string>& figures = {});

}  // namespace flowslide::study
