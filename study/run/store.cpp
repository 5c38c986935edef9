#include "study/run/store.hpp"

#include "core/files.hpp"
#include "workflows/engine/result_folder.hpp"
#include "workflows/engine/sealed_json.hpp"

#include <algorithm>

namespace fs = std::filesystem;

namespace flowslide::study {
namespace {

constexpr int kStoreSchema = 1;
constexpr std::string_view kGone = ".gone";

/// Two processes may clear the same away, and what stays goes with the next sweep.
void remove_waste(const fs::path& path) {
  try {
    remove_path(path);
  } catch (const FileError&) {
    return;
  }
}

std::optional<Json> read(const fs::path& path) {
  auto file = read_sealed(path).json;
  if (!file || !file->contains("schema") || (*file)["schema"] != kStoreSchema) return std::nullopt;
  return file;
}

}  // namespace

fs::path Store::result(const std::string& stage, const std::string& key) const {
  return result_folder(folder_, stage, key);
}

fs::path Store::beside(const std::string& stage, const std::string& key,
                       std::string_view ending) const {
  return result(stage, key).string() + std::string(ending);
}

std::optional<Finished> Store::finished(const std::string& stage, const std::string& key) const {
  const auto json = read(beside(stage, key, ".json"));
  if (!json) return std::nullopt;
  try {
    Finished f{.record = record_from(json->at("record")),
               .peak_memory = json->at("peak_memory_bytes")};
    f.record.facts = json->at("facts").dump();
    if (f.record.stage != stage || f.record.key != key) return std::nullopt;
    return f;
  } catch (const Json::exception&) {
    return std::nullopt;
  } catch (const InputError&) {
    return std::nullopt;
  }
}

void Store::write(const Finished& finished) const {
  const StageRecord& record = finished.record;
  write_file(beside(record.stage, record.key, ".json"),
             seal({{"schema", kStoreSchema},
                   {"record", to_json(record)},
                   {"facts", Json::parse(record.facts)},
                   {"peak_memory_bytes", finished.peak_memory}}));
}

std::optional<Failure> Store::failure(const std::string& stage, const std::string& key) const {
  const auto json = read(beside(stage, key, ".failed.json"));
  if (!json) return std::nullopt;
  try {
    return Failure{.code = static_cast<int>(whole_number(json->at("code")) % 256u),
                   .text = json->at("text"),
                   .program = json->at("program"),
                   .permanent = json->at("permanent")};
  } catch (const Json::exception&) {
    return std::nullopt;
  } catch (const InputError&) {
    return std::nullopt;
  }
}

void Store::write(const std::string& stage, const std::string& key, const Failure& failure) const {
  const fs::path path = beside(stage, key, ".failed.json");
  make_folders(path.parent_path());
  write_file(path, seal({{"schema", kStoreSchema},
                         {"code", failure.code},
                         {"text", failure.text},
                         {"program", failure.program},
                         {"permanent", failure.permanent}}));
}

void Store::forget_failure(const std::string& stage, const std::string& key) const {
  remove_path(beside(stage, key, ".failed.json"));
}

bool Store::has_files(const std::string& stage, const std::string& key) const {
  return is_there(result(stage, key) / kRecordFile);
}

void Store::drop_files(const std::string& stage, const std::string& key) const {
  const fs::path folder = result(stage, key), gone = folder.string() + std::string(kGone);
  if (own_type_of(folder) == fs::file_type::not_found) return;
  remove_waste(gone);
  rename_durably(folder, gone);
  remove_waste(gone);
}

void Store::sweep() const {
  std::error_code error;
  for (const auto& stage : fs::directory_iterator(folder_ / "stages", error)) {
    if (!stage.is_directory() || stage.is_symlink()) continue;
    std::vector<fs::path> gone;
    for (const auto& entry : fs::directory_iterator(stage.path(), error))
      if (entry.path().extension() == kGone) gone.push_back(entry.path());
    for (const fs::path& path : gone) remove_waste(path);
  }
}

double bytes_of(const fs::path& path) {
  std::error_code error;
  const fs::file_status status = fs::symlink_status(path, error);
  if (fs::is_regular_file(status)) {
    const auto size = fs::file_size(path, error);
    return error ? 0.0 : static_cast<double>(size);
  }
  double sum = 0.0;
  if (fs::is_directory(status))
    // Others may take files away meanwhile.
    for (fs::directory_iterator it(path, error), end; !error && it != end; it.increment(error))
      sum += bytes_of(it->path());
  return sum;
}

void write_plan(const fs::path& folder, const Plan& plan) {
  write_file(folder / kPlanFile, seal(to_json(plan)));
}

Plan read_plan(const fs::path& folder) {
  if (!is_there(folder))
    throw InputError(fmt::format(
        "{}: no folder of a study (there is no such folder). Name the one that 'flowslide study run' "
        "has made.",
        folder.string()));
  const SealedJson file = read_sealed(folder / kPlanFile);
  if (!file.json)
    throw InputError(fmt::format(
        "{}: no folder of a study ({}). Name the one that 'flowslide study run' has made.",
        folder.string(), file.problem.empty() ? "it has no study.json" : file.problem));
  try {
    return plan_from(*file.json);
  } catch (const Json::exception& e) {
    throw InputError(fmt::format("{}: cannot be used ({}). Run the study again.",
                                 (folder / kPlanFile).string(), e.what()));
  }
}

}  // namespace flowslide::study
