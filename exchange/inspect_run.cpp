#include "exchange/inspect_run.hpp"

#include "core/check.hpp"
#include "core/files.hpp"
#include "workflows/engine/lock.hpp"
#include "workflows/engine/publish.hpp"
#include "workflows/engine/session.hpp"

#include <algorithm>
#include <vector>

namespace fs = std::filesystem;

namespace flowslide {
namespace {

/// Folders in a folder, links left out, by name.
std::vector<fs::path> folders_in(const fs::path& folder) {
  std::vector<fs::path> found;
  if (type_of(folder) != fs::file_type::directory) return found;
  for (const auto& entry : fs::directory_iterator(folder))
    if (entry.is_directory() && !entry.is_symlink()) found.push_back(entry.path());
  std::sort(found.begin(), found.end());
  return found;
}

/// Between two looks of verify(), or less at the end of a file: good enough for a share.
constexpr double kBlockBytes = 1 << 16;

/// Bytes that are to be read and those that have been.
class Counted {
 public:
  Counted(double all, const std::function<void(double)>& tick) : all_(all), tick_(tick) {}
  void add(double bytes) {
    done_ += bytes;
    if (tick_ && all_ > 0.0) tick_(std::min(1.0, done_ / all_));
  }

 private:
  double all_, done_ = 0.0;
  const std::function<void(double)>& tick_;
};

double bytes_of_results(const fs::path& folder) {
  double bytes = 0.0;
  for (const fs::path& stage : folders_in(folder / "stages"))
    for (const fs::path& result : folders_in(stage)) {
      std::error_code error;
      for (fs::recursive_directory_iterator it(result, error), end; !error && it != end;
           it.increment(error)) {
        std::error_code gone;
        if (it->is_regular_file(gone)) bytes += static_cast<double>(it->file_size(gone));
      }
    }
  return bytes;
}

std::vector<std::string> problems_of_result(const fs::path& result, Counted& counted) {
  const RecordRead read = read_stage_record(result);
  if (!read.record) return {read.problem};
  return verify(*read.record, result, [&counted] { counted.add(kBlockBytes); }).problems;
}

/// Stages without checkpoints leave nothing that could be continued.
std::vector<std::string> problems_of_work(const fs::path& work) {
  if (!is_there(work / kSessionFile)) return {};
  const std::string problem = read_session(work).problem;
  return problem.empty() ? std::vector<std::string>{} : std::vector{problem};
}

void add_problems(Json& list, const fs::path& folder, const std::function<void(double)>& tick) {
  Counted counted(tick ? bytes_of_results(folder) : 0.0, tick);
  for (const fs::path& stage : folders_in(folder / "stages"))
    for (const fs::path& result : folders_in(stage)) {
      const bool work = result.extension() == ".partial";
      for (const std::string& text :
           work ? problems_of_work(result) : problems_of_result(result, counted))
        list.push_back(
            fmt::format("{}: {}", result.lexically_relative(folder).generic_string(), text));
    }
}

/// Stages in the order in which they ran, as the result has them; the rest by name.
std::vector<std::string> in_order(const RunLock& lock, const std::optional<Json>& result) {
  std::vector<std::string> names;
  const auto add = [&names, &lock](const std::string& name) {
    if (lock.stages.count(name) > 0 && std::ranges::find(names, name) == names.end())
      names.push_back(name);
  };
  if (result && result->contains("stages"))
    for (const auto& [name, stage] : (*result)["stages"].items()) add(name);
  for (const auto& [name, record] : lock.stages) add(name);
  return names;
}

}  // namespace

Json inspect_run(const fs::path& folder, const std::function<void(double)>& tick) {
  const auto [lock, problem] = read_lock(folder);
  if (!lock && problem.empty())
    throw InputError(
        fmt::format("{}: a folder without run.lock (no run of flowslide). Name one of "
                    "its files.",
                    folder.string()));
  Json j = {{"kind", "run"}};
  Json problems = Json::array();
  if (!lock) problems.push_back(problem);
  const SealedJson result = read_sealed(folder / kResultFile);
  if (lock) {
    j["workflow"] = lock->workflow;
    j["file"] = lock->file;
    j["complete"] = lock->complete && result.json;
    j["stages"] = Json::object();
    for (const std::string& name : in_order(*lock, result.json)) {
      const StageRecord& record = lock->stages.at(name);
      j["stages"][name] = {{"uses", record.uses},
                           {"seconds", record.seconds},
                           {"key", record.key},
                           {"program", record.program}};
    }
    for (const std::string& text : problems_at_top(folder, *lock)) problems.push_back(text);
  }
  add_problems(problems, folder, tick);
  j["problems"] = problems;
  if (result.json)
    for (const auto& [key, value] : result.json->items())
      if (value.is_number() && key != "schema") j["result"][key] = value;
  return j;
}

}  // namespace flowslide
