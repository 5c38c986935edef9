#include "workflows/engine/costs.hpp"

#include "core/elementary.hpp"
#include "workflows/engine/earlier.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace flowslide {
namespace {

constexpr std::size_t kMostAlike = 3, kMostOfAKind = 40;
constexpr double kUsualDiffersIn = 30.0;
/// Of a stage that says nothing: its records are compared with each other.
constexpr Work kNothingSaid{.seconds = 1.0, .parallel = 0.0, .memory = kUnset};

/// FNV-1a. Where two lines have the same, a stage seems a little more alike than it is.
std::uint32_t short_hash(std::string_view text, std::uint32_t hash = 2166136261u) {
  for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 16777619u;
  return hash;
}

void add_settings(const WorkflowStage& stage, std::vector<std::uint32_t>& settings) {
  const std::uint32_t own = short_hash(stage.type.name);
  std::string_view text = stage.prepared.settings;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    if (end > 0) settings.push_back(short_hash(text.substr(0, end), own));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
}

/// In how many settings two differ: one that has another value counts once.
double differences(const std::vector<std::uint32_t>& a, const std::vector<std::uint32_t>& b) {
  std::size_t common = 0;
  for (auto i = a.begin(), k = b.begin(); i != a.end() && k != b.end();) {
    if (*i == *k) ++common;
    const bool first = *i <= *k, second = *k <= *i;
    i += first ? 1 : 0;
    k += second ? 1 : 0;
  }
  return static_cast<double>(std::max(a.size(), b.size()) - common);
}

double weight_of(double differences) { return 1.0 / ((1.0 + differences) * (1.0 + differences)); }

/// A ratio as a machine may have it: 1e9 comes from a damaged file or a clock that was set.
bool is_ratio(double x) { return x > 1e-6 && x < 1e6; }

/// Geometric mean with weights.
struct Mean {
  double weight = 0.0, sum = 0.0;
  void add(double value, double w) {
    weight += w;
    sum += w * log(value);
  }
  [[nodiscard]] double value() const { return weight > 0.0 ? exp(sum / weight) : kUnset; }
};

double number_or_nan(const Json& json) { return json.is_null() ? kUnset : json.get<double>(); }

}  // namespace

Task task_of(const Workflow& workflow, std::size_t stage) {
  const WorkflowStage& own = workflow.stages[stage];
  Task task{.uses = own.type.name, .work = own.work, .settings = {}};
  const std::vector<bool> feeds = feeding_stages(workflow, own);
  for (std::size_t i = 0; i < feeds.size(); ++i)
    if (feeds[i] && i != stage) add_settings(workflow.stages[i], task.settings);
  add_settings(own, task.settings);
  std::sort(task.settings.begin(), task.settings.end());
  return task;
}

void CostTable::add(CostRecord record) {
  if (!is_ratio(record.seconds)) return;
  if (!is_ratio(record.memory)) record.memory = kUnset;
  std::vector<CostRecord>& kind = records_[record.uses];
  const auto alike = [&](const CostRecord& r) { return r.settings == record.settings; };
  const auto count = std::count_if(kind.begin(), kind.end(), alike);
  if (static_cast<std::size_t>(count) >= kMostAlike)
    kind.erase(std::find_if(kind.begin(), kind.end(), alike));
  else if (kind.size() >= kMostOfAKind)
    kind.erase(kind.begin());
  kind.push_back(std::move(record));
}

Cost CostTable::expect(const Task& task, int threads) const {
  const bool said = is_set(task.work.seconds);
  const Work& work = said ? task.work : kNothingSaid;
  Mean seconds, memory;
  if (said) seconds.add(1.0, weight_of(kUsualDiffersIn));
  if (is_set(work.memory)) memory.add(1.0, weight_of(kUsualDiffersIn));
  if (const auto kind = records_.find(task.uses); kind != records_.end())
    for (const CostRecord& r : kind->second) {
      const double weight = weight_of(differences(task.settings, r.settings));
      seconds.add(r.seconds, weight);
      if (is_set(r.memory)) memory.add(r.memory, weight);
    }
  return {seconds.value() * work.on(threads), memory.value() * work.memory};
}

CostRecord record_of(const Task& task, int threads, double seconds, double memory) {
  const Work& work = is_set(task.work.seconds) ? task.work : kNothingSaid;
  return {.uses = task.uses,
          .seconds = seconds / work.on(threads),
          .memory = memory > 0.0 ? memory / work.memory : kUnset,
          .settings = task.settings};
}

Json to_json(const CostTable& table) {
  Json kinds = Json::object();
  for (const auto& [uses, records] : table.records()) {
    Json list = Json::array();
    for (const CostRecord& r : records)
      list.push_back({{"seconds", r.seconds},
                      {"memory", is_set(r.memory) ? Json(r.memory) : Json(nullptr)},
                      {"settings", r.settings}});
    kinds[uses] = std::move(list);
  }
  return {{"schema", 1}, {"stages", std::move(kinds)}};
}

CostTable costs_from(const Json& json) {
  validate(json.at("schema") == 1, "schema {} is of another version", json.at("schema").dump());
  CostTable table;
  for (const auto& [uses, list] : json.at("stages").items())
    for (const Json& r : list) {
      CostRecord record{.uses = uses,
                        .seconds = number_or_nan(r.at("seconds")),
                        .memory = number_or_nan(r.at("memory")),
                        .settings = {}};
      for (const Json& hash : r.at("settings")) {
        const std::uint64_t number = whole_number(hash);
        validate(number <= std::numeric_limits<std::uint32_t>::max(), "{} is no hash", number);
        record.settings.push_back(static_cast<std::uint32_t>(number));
      }
      validate(std::is_sorted(record.settings.begin(), record.settings.end()),
               "hashes of {} are not in order", uses);
      table.add(std::move(record));
    }
  return table;
}

}  // namespace flowslide
