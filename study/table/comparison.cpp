#include "study/table/comparison.hpp"

#include <algorithm>
#include <array>
#include <map>

#include <fmt/format.h>

namespace flowslide::study {
namespace {

using Sides = std::array<std::vector<double>, 2>;  ///< the main variant, the other

/// Names of the inputs that rows of a variant have.
std::set<std::string> inputs_of(const Plan& plan, const std::string& variant) {
  std::set<std::string> names;
  for (const Row& row : plan.rows)
    if (row.variant == variant)
      for (const auto& [name, value] : row.values) names.insert(name);
  return names;
}

class Comparer {
 public:
  Comparer(const Plan& plan, const Observations& observed, const std::string& variant,
           const Column& c)
      : plan_(plan), observed_(observed), variant_(variant), column_(c) {
    shared_ = inputs_of(plan, variant);
    const std::set<std::string> own = inputs_of(plan, observed.variant());
    std::erase_if(shared_, [&](const std::string& name) { return !own.contains(name); });
    sort_by_values();
  }

  void add_to(StudyFindings& f, const Resampling& resampling) const {
    if (by_values_.empty()) {
      f.not_compared.push_back({variant_, column_.name, why_not()});
      return;
    }
    Sides all;
    for (const auto& [where, sides] : by_values_) {
      for (std::size_t s = 0; s < 2; ++s)
        all[s].insert(all[s].end(), sides[s].begin(), sides[s].end());
      f.comparisons.push_back(
          {variant_, column_.name, where, ratio_of_means(sides[0], sides[1], resampling)});
    }
    if (by_values_.size() > 1)
      f.comparisons.push_back(
          {variant_, column_.name, "", ratio_of_means(all[0], all[1], resampling)});
  }

 private:
  /// Means of groups on both sides, by the values of the inputs that the variants share.
  void sort_by_values() {
    const std::vector<double> values = observed_.distinct(column_);
    for (const auto& rows : observed_.repeats().groups) {
      const Row& row = plan_.rows[rows[0]];
      if (row.variant != observed_.variant() && row.variant != variant_) continue;
      std::vector<double> here;
      for (const std::size_t r : rows)
        if (is_set(values[r])) here.push_back(values[r]);
      if (here.empty()) continue;
      const std::size_t side = row.variant == variant_;
      ++groups_[side];
      by_values_[place_of(row, shared_)][side].push_back(mean(here));
    }
    std::erase_if(by_values_, [](const auto& entry) {
      return entry.second[0].empty() || entry.second[1].empty();
    });
  }

  [[nodiscard]] std::string why_not() const {
    for (std::size_t side = 0; side < 2; ++side)
      if (groups_[side] == 0)
        return fmt::format("no row of {} has found a {}",
                           side == 0 ? observed_.variant() : variant_, column_.name);
    return fmt::format("no row of {} has the values of a row of {} in {}", observed_.variant(),
                       variant_, fmt::join(shared_, ", "));
  }

  const Plan& plan_;
  const Observations& observed_;
  const std::string& variant_;
  const Column& column_;
  std::set<std::string> shared_;
  std::map<std::string, Sides> by_values_;
  std::array<std::size_t, 2> groups_{};
};

}  // namespace

void add_comparisons(const Plan& plan, const Table& table, const Observations& observed,
                     const Resampling& resampling, StudyFindings& findings) {
  std::set<std::string> variants;
  for (const Row& row : plan.rows)
    if (row.variant != observed.variant()) variants.insert(row.variant);
  for (const std::string& variant : variants)
    for (const std::string& result : findings.results)
      Comparer(plan, observed, variant, *table.find(result)).add_to(findings, resampling);
}

}  // namespace flowslide::study
