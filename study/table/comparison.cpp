#include "study/table/comparison.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <numeric>

#include <fmt/format.h>

namespace flowslide::study {
namespace {

/// Of one variant: what its groups have found, and what of it comes and goes together.
struct Side {
  std::vector<double> value;
  std::vector<std::size_t> unit, stratum;
  void add(const Side& other) {
    value.insert(value.end(), other.value.begin(), other.value.end());
    unit.insert(unit.end(), other.unit.begin(), other.unit.end());
    stratum.insert(stratum.end(), other.stratum.begin(), other.stratum.end());
  }
};
using Sides = std::array<Side, 2>;  ///< the main variant, the other

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
  Comparer(const Plan& plan, const Table& table, const Observations& observed,
           const std::string& variant, const Column& c)
      : plan_(plan), observed_(observed), variant_(variant), column_(c) {
    shared_ = inputs_of(plan, variant);
    const std::set<std::string> own = inputs_of(plan, observed.variant());
    // what the number does not hang on parts nothing
    std::erase_if(shared_, [&](const std::string& name) {
      return !own.contains(name) || !observed.feeds(*table.find(name), c);
    });
    sort_by_values();
  }

  void add_to(StudyFindings& f, const Resampling& resampling) const {
    if (by_values_.empty()) {
      f.not_compared.push_back({variant_, column_.name, why_not()});
      return;
    }
    Sides all;
    for (const auto& [where, sides] : by_values_) {
      for (std::size_t s = 0; s < 2; ++s) all[s].add(sides[s]);
      f.comparisons.push_back({variant_, column_.name, where, ratio(sides, resampling)});
    }
    if (by_values_.size() > 1)
      f.comparisons.push_back({variant_, column_.name, "", ratio(all, resampling)});
  }

 private:
  /// A unit of the main variant has rows of every value; the other's are drawn for each by itself.
  [[nodiscard]] static Estimate ratio(const Sides& sides, const Resampling& resampling) {
    Resampling over = resampling, under = resampling;
    over.units = sides[0].unit;
    under.units = sides[1].unit;
    under.strata = sides[1].stratum;
    return ratio_of_means(sides[0].value, over, sides[1].value, under);
  }

  /// Means of groups on both sides, by the values of the inputs that the variants share.
  void sort_by_values() {
    const std::vector<double> values = observed_.distinct(column_);
    std::vector<std::size_t> all(observed_.groups().size());
    std::iota(all.begin(), all.end(), std::size_t{0});
    const std::vector<std::size_t> units = observed_.units(all, column_);
    std::map<std::size_t, std::size_t> unit_of;
    for (std::size_t i = 0; i < units.size(); ++i) unit_of[observed_.groups()[i]] = units[i];
    for (std::size_t g = 0; g < observed_.repeats().groups.size(); ++g) {
      const std::vector<std::size_t>& rows = observed_.repeats().groups[g];
      const Row& row = plan_.rows[rows[0]];
      if (row.variant != observed_.variant() && row.variant != variant_) continue;
      std::vector<double> here;
      for (const std::size_t r : rows)
        if (is_set(values[r])) here.push_back(values[r]);
      if (here.empty()) continue;
      const std::size_t side = row.variant == variant_;
      ++groups_[side];
      const auto [place, is_new] = by_values_.try_emplace(place_of(row, shared_));
      if (is_new) stratum_of_[place->first] = stratum_of_.size();
      Side& to = place->second[side];
      to.value.push_back(mean(here));
      to.unit.push_back(side == 0              ? unit_of.at(g)
                        : column_.node.empty() ? g
                                               : column_.node[rows[0]]);
      to.stratum.push_back(stratum_of_.at(place->first));
    }
    std::erase_if(by_values_, [](const auto& entry) {
      return entry.second[0].value.empty() || entry.second[1].value.empty();
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
  std::map<std::string, std::size_t> stratum_of_;
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
      Comparer(plan, table, observed, variant, *table.find(result)).add_to(findings, resampling);
}

}  // namespace flowslide::study
