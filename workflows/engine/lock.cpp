#include "workflows/engine/lock.hpp"

#include "core/check.hpp"
#include "core/files.hpp"
#include "workflows/engine/names.hpp"

namespace fs = std::filesystem;

namespace flowslide {
namespace {

constexpr int kLockSchema = 2;
constexpr std::string_view kLockFile = "run.lock";

RunLock lock_from(const Json& json) {
  validate(json.at("schema") == kLockSchema, "another program wrote it");
  RunLock lock{.workflow = json.at("workflow"),
               .file = json.at("file"),
               .overrides = json.at("set"),
               .complete = json.at("complete"),
               .published = {},
               .given = json.at("given"),
               .stages = {}};
  for (const auto& [name, target] : json.at("published").items()) {
    lock.published.push_back({name, target});
    validate(stays_inside(name) && name.find('/') == std::string::npos,
             "'{}' is no name at the top of the run folder", name);
    validate(stays_inside(lock.published.back().target), "'{}' leaves the run folder",
             lock.published.back().target);
  }
  for (const auto& [name, digest] : lock.given)
    validate(stays_inside(name) && is_digest(digest), "'{}' leaves the run folder", name);
  for (const auto& [name, record] : json.at("stages").items()) {
    StageRecord& stage = lock.stages[name] = record_from(record);
    validate(stage.stage == name, "the record of '{}' is that of '{}'", name, stage.stage);
  }
  return lock;
}

}  // namespace

void write_lock(const fs::path& run_folder, const RunLock& lock) {
  Json stages = Json::object();
  for (const auto& [name, record] : lock.stages) stages[name] = to_json(record);
  Json published = Json::object();
  for (const Publication& item : lock.published) published[item.name] = item.target;
  write_file(run_folder / kLockFile, seal({{"schema", kLockSchema},
                                           {"workflow", lock.workflow},
                                           {"file", lock.file},
                                           {"set", lock.overrides},
                                           {"complete", lock.complete},
                                           {"published", published},
                                           {"given", lock.given},
                                           {"stages", stages}}));
}

LockRead read_lock(const fs::path& run_folder) {
  const SealedJson file = read_sealed(run_folder / kLockFile);
  if (!file.json) return {{}, file.problem};
  const auto cannot_be_used = [](const std::exception& e) {
    return LockRead{{}, fmt::format("{} is not used ({})", kLockFile, e.what())};
  };
  try {
    return {lock_from(*file.json), {}};
  } catch (const Json::exception& e) {
    return cannot_be_used(e);
  } catch (const InputError& e) {
    return cannot_be_used(e);
  }
}

}  // namespace flowslide
