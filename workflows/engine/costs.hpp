#pragma once
#include "workflows/engine/graph.hpp"
#include "workflows/engine/sealed_json.hpp"

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

/// What stages are expected to take: docs/adr/0016-expected-cost.md.
namespace flowslide {

/// Wall time [s] and memory [bytes]; NaN where nothing is known.
struct Cost {
  double seconds = kUnset, memory = kUnset;
};

/// A stage of a workflow as its cost hangs on it.
struct Task {
  std::string uses;
  Work work;
  /// Short hashes of the settings, one by one, of the stage and all that feed it; sorted.
  std::vector<std::uint32_t> settings;
};
Task task_of(const Workflow& workflow, std::size_t stage);

/// What a stage took, over what its Work says.
struct CostRecord {
  std::string uses;
  double seconds = 1.0;
  double memory = kUnset;
  std::vector<std::uint32_t> settings;
};

/// Records of earlier stages. What is expected is the Work of a stage times the mean of the ratios
/// of its kind, in which a record weighs the more the fewer settings differ; the ratio 1 of the
/// usual machine takes part as a record that differs in thirty.
class CostTable {
 public:
  /// The newest are kept: 3 with equal settings, 40 of a kind.
  void add(CostRecord record);
  [[nodiscard]] Cost expect(const Task& task, int threads) const;
  [[nodiscard]] const std::map<std::string, std::vector<CostRecord>>& records() const {
    return records_;
  }

 private:
  std::map<std::string, std::vector<CostRecord>> records_;  ///< by `uses`, oldest first
};

/// `memory` 0: unknown.
CostRecord record_of(const Task& task, int threads, double seconds, double memory);

Json to_json(const CostTable& table);
/// Throws Json::exception and InputError for what is no table.
CostTable costs_from(const Json& json);

}  // namespace flowslide
