#include "study/run/clean.hpp"

#include "core/files.hpp"
#include "study/run/locks.hpp"

#include <map>
#include <set>

namespace fs = std::filesystem;

namespace flowslide::study {

Cleaned clean(const Plan& plan, const Store& store, const StudyState& progress, bool dry_run) {
  constexpr std::size_t kDigits = 16;
  std::set<std::string> needed;
  for (std::size_t n = 0; n < plan.nodes.size(); ++n) {
    const NodeState& state = progress.node(n);
    if (!state.key.empty())
      needed.insert(plan.nodes[n].stage.name + "/" + state.key.substr(0, kDigits));
  }
  std::map<std::string, std::vector<fs::path>> waste;  // by key
  const fs::path stages = store.folder() / "stages";
  if (!is_there(stages)) return {};
  for (const auto& stage : fs::directory_iterator(stages)) {
    if (!stage.is_directory() || stage.is_symlink()) continue;
    for (const auto& entry : fs::directory_iterator(stage.path())) {
      const std::string name = entry.path().filename().string(), key = name.substr(0, kDigits);
      const bool is_key =
          key.size() == kDigits && key.find_first_not_of("0123456789abcdef") == std::string::npos;
      if (is_key && !needed.contains(stage.path().filename().string() + "/" + key))
        waste[key].push_back(entry.path());
    }
  }
  Cleaned cleaned;
  Locks locks(store.folder());
  for (const auto& [key, paths] : waste) {
    if (!locks.take(key)) {
      ++cleaned.in_use;
      continue;
    }
    ++cleaned.results;
    for (const fs::path& path : paths) {
      cleaned.bytes += bytes_of(path);
      if (!dry_run) remove_path(path);
    }
    locks.release(key);
  }
  return cleaned;
}

}  // namespace flowslide::study
