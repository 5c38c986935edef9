#pragma once
#include "study/statistics/ranks.hpp"
#include "study/statistics/repeats.hpp"
#include "study/statistics/summary.hpp"
#include "study/table/table.hpp"

#include <set>
#include <string>
#include <utility>
#include <vector>

namespace flowslide::study {

/// What the rows of a study have observed. Rows that differ in their repeat only are a group; the
/// groups of the variant with the most of them are what the study is about; and what one stage has
/// found is one observation, however many rows take it on. docs/theory/study-statistics.md
class Observations {
 public:
  Observations(const Plan& plan, const Table& table);

  [[nodiscard]] const Repeats& repeats() const { return repeats_; }
  [[nodiscard]] const std::string& variant() const { return variant_; }
  /// Those of the variant: indices into repeats().groups.
  [[nodiscard]] const std::vector<std::size_t>& groups() const { return groups_; }
  /// The first row of the i-th group of the variant.
  [[nodiscard]] std::size_t row(std::size_t i) const { return repeats_.groups[groups_[i]][0]; }

  /// What each row has found, once for each group: repeats that did not disturb the stage that
  /// found it are no repeats of it. NaN for the others.
  [[nodiscard]] std::vector<double> distinct(const Column& c) const;
  /// Mean of each group of the variant, over its repeats.
  [[nodiscard]] std::vector<double> means(const Column& c) const;
  /// All that the groups of the variant have observed, every repeat and what one stage has found
  /// once, each group with the weight 1.
  [[nodiscard]] Exceedance exceedance_of(const Column& c) const;

  /// The groups of the variant that are one observation of y each: what one stage has found, with
  /// and without repeats, counts once for each x, by the group with the most repeats.
  [[nodiscard]] std::vector<std::size_t> places(const Column& x, const Column& y) const;
  /// For each of those groups what shares its draws in resampling: the groups that share the finest
  /// stage before y which several of them, and not all, have in common (a shaking), or that which
  /// found y.
  [[nodiscard]] std::vector<std::size_t> units(const std::vector<std::size_t>& groups,
                                               const Column& y) const;
  [[nodiscard]] Pairs pairs(const Column& x, const Column& y) const;

  /// Does an input set a stage that found the result, or one before it?
  [[nodiscard]] bool feeds(const Column& x, const Column& y) const;
  /// Inputs of few values that y hangs on and x does not.
  [[nodiscard]] std::set<std::string> beside(const Column& x, const Column& y) const;

 private:
  const Plan& plan_;
  const Table& table_;
  Repeats repeats_;
  std::string variant_;
  std::vector<std::size_t> groups_;
};

/// The values of a row for the inputs of those names, as "pga 0.3 g, c_soft 0.5"; "0.30 g" is 0.3
/// g.
std::string place_of(const Row& row, const std::set<std::string>& names);

}  // namespace flowslide::study
