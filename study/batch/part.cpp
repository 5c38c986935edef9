#include "study/batch/part.hpp"

#include "core/files.hpp"
#include "workflows/engine/names.hpp"
#include "workflows/engine/sealed_json.hpp"

#include <algorithm>
#include <unordered_set>

namespace fs = std::filesystem;

namespace flowslide::study {
namespace {

constexpr int kSchema = 1;

ArrayRecord from(const Json& json) {
  validate(json.at("schema") == kSchema, "another program wrote it");
  ArrayRecord record{.cpus = static_cast<std::size_t>(whole_number(json.at("cpus"))),
                     .memory = json.at("memory_bytes"),
                     .retry = json.at("retry"),
                     .allowed_programs = json.at("allow").get<std::vector<std::string>>(),
                     .tasks = json.at("tasks").get<std::vector<std::vector<std::string>>>()};
  constexpr std::size_t kMostCpus = 4096;
  validate(record.cpus > 0 && record.cpus <= kMostCpus && record.memory > 0.0,
           "a task needs a processor and memory");
  for (const auto& task : record.tasks)
    for (const std::string& recipe : task) validate(is_digest(recipe), "'{}' is no digest", recipe);
  return record;
}

}  // namespace

void write_array(const fs::path& file, const ArrayRecord& record) {
  write_file(file, seal({{"schema", kSchema},
                         {"cpus", record.cpus},
                         {"memory_bytes", record.memory},
                         {"retry", record.retry},
                         {"allow", record.allowed_programs},
                         {"tasks", record.tasks}}));
}

ArrayRecord read_array(const fs::path& file) {
  const SealedJson sealed = read_sealed(file);
  if (!sealed.json && sealed.problem.empty())
    throw FileError(fmt::format(
        "{}: is not there (the folder of a study must lie where every machine of the cluster sees it "
        "under the same name). Choose an --out on a file system that they share.",
        file.string()));
  if (!sealed.json)
    throw InputError(fmt::format("{}: {}. Run the study again.", file.string(), sealed.problem));
  try {
    return from(*sealed.json);
  } catch (const Json::exception& e) {
    throw InputError(
        fmt::format("{}: cannot be used ({}). Run the study again.", file.string(), e.what()));
  }
}

std::vector<bool> nodes_of_task(const Plan& plan, const ArrayRecord& record, std::size_t task) {
  validate(task < record.tasks.size(),
           "there is no task {} (the array has {}, counted from 0). Give one of these.", task,
           record.tasks.size());
  const std::unordered_set<std::string> recipes(record.tasks[task].begin(),
                                                record.tasks[task].end());
  std::vector<bool> nodes(plan.nodes.size());
  for (std::size_t n = 0; n < nodes.size(); ++n) nodes[n] = recipes.contains(plan.nodes[n].recipe);
  return nodes;
}

}  // namespace flowslide::study
