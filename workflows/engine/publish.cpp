#include "workflows/engine/publish.hpp"

#include "core/check.hpp"
#include "core/files.hpp"
#include "core/hash.hpp"
#include "workflows/engine/result_folder.hpp"

#include <algorithm>
#include <array>

namespace fs = std::filesystem;

namespace flowslide {
namespace {

constexpr std::uint64_t kLongestText = 64u << 20;  ///< of a .pvd or a file given to the user
constexpr std::string_view kStages = "stages/";
/// Names that are not to be had at the top.
constexpr std::array<std::string_view, 4> kTaken{kResultFile, "run.lock", "stages",
                                                 ".flowslide.lock"};

std::string replace_all(std::string text, std::string_view from, const std::string& to) {
  for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size())
    text.replace(at, from.size(), to);
  return text;
}

bool is_taken(const fs::path& path) { return own_type_of(path) != fs::file_type::not_found; }

bool is_link(const fs::path& path) { return own_type_of(path) == fs::file_type::symlink; }

/// Where a link points; empty if it is none.
std::string link_target(const fs::path& path) {
  std::error_code error;
  return fs::read_symlink(path, error).generic_string();
}

bool is_file(const fs::path& path) { return own_type_of(path) == fs::file_type::regular; }

/// A link into the results, or a rewritten .pvd, as only publish() makes them.
bool is_published(const fs::path& path) {
  if (is_link(path)) return link_target(path).starts_with(kStages);
  return path.extension() == ".pvd" && is_file(path) &&
         read_file(path, kLongestText).find(fmt::format("file=\"{}", kStages)) != std::string::npos;
}

std::string published_pvd(const fs::path& run_folder, const fs::path& target) {
  const std::string prefix = target.parent_path().generic_string() + "/";
  return replace_all(read_file(run_folder / target, kLongestText), "file=\"", "file=\"" + prefix);
}

/// Checksum of a file below the run folder; that of nothing for anything else that is in the way, a
/// link above all; empty if there is nothing.
std::optional<std::string> present_digest(const fs::path& run_folder, const std::string& name) {
  const fs::path top = *fs::path(name).begin();
  if (std::find(kTaken.begin(), kTaken.end(), top.string()) != kTaken.end()) return sha256("");
  fs::path folder = run_folder;
  for (const fs::path& part : fs::path(name).parent_path())
    if (is_link(folder /= part)) return sha256("");
  if (!is_taken(run_folder / name)) return std::nullopt;
  return sha256(is_file(run_folder / name) ? read_file(run_folder / name, kLongestText) : "");
}

}  // namespace

std::vector<Publication> publications(const std::vector<StageRecord>& records) {
  std::vector<Publication> items;
  const auto taken = [&](const std::string& name) {
    return std::find(kTaken.begin(), kTaken.end(), name) != kTaken.end() ||
           std::any_of(items.begin(), items.end(),
                       [&](const Publication& p) { return p.name == name; });
  };
  for (const StageRecord& record : records) {
    for (const std::string& file : record.publish) {
      std::string name = fs::path(file).filename().string();
      if (taken(name)) name = record.stage + "." + name;
      const fs::path target = result_folder({}, record.stage, record.key) / file;
      items.push_back({name, target.generic_string()});
    }
  }
  return items;
}

void publish(const fs::path& run_folder, const Publication& item, bool ours) {
  const fs::path path = run_folder / item.name;
  if (is_taken(path) && !is_published(path) && !(ours && is_file(path)))
    throw FileError(
        fmt::format("'{}' was not made by this program (a result of that name goes "
                    "there). Give it another name or choose another --out.",
                    path.string()));
  if (path.extension() == ".pvd") {
    write_file(path, published_pvd(run_folder, item.target));
    return;
  }
  if (link_target(path) == item.target) return;
  const fs::path temporary = temporary_name(path);
  std::error_code error;
  fs::create_symlink(item.target, temporary, error);
  if (error)
    throw FileError(fmt::format("'{}' cannot be made ({})", path.string(), error.message()));
  rename_durably(temporary, path);
}

void withdraw(const fs::path& run_folder, const std::optional<RunLock>& lock) {
  remove_path(run_folder / kResultFile);
  if (lock) {
    for (const Publication& item : lock->published) {
      const fs::path path = run_folder / item.name;
      // A .pvd that has been damaged no longer looks like one of ours.
      if (is_published(path) || (path.extension() == ".pvd" && is_file(path))) remove_path(path);
    }
  } else {
    std::vector<fs::path> links;
    for (const auto& entry : fs::directory_iterator(run_folder))
      if (entry.is_symlink() && is_published(entry.path())) links.push_back(entry.path());
    for (const fs::path& link : links) remove_path(link);
  }
  sync_path(run_folder);
}

std::vector<std::string> problems_at_top(const fs::path& run_folder, const RunLock& lock) {
  std::vector<std::string> problems;
  if (!lock.complete) return problems;
  const SealedJson result = read_sealed(run_folder / kResultFile);
  if (!result.json)
    problems.push_back(result.problem.empty() ? fmt::format("{} is missing", kResultFile)
                                              : result.problem);
  for (const Publication& item : lock.published) {
    const fs::path path = run_folder / item.name;
    if (!is_taken(path)) {
      problems.push_back(fmt::format("{} is missing", item.name));
    } else if (path.extension() != ".pvd") {
      if (link_target(path) != item.target)
        problems.push_back(fmt::format("{} is not the link that the run made", item.name));
    } else if (is_file(run_folder / item.target) &&
               (!is_file(path) ||
                read_file(path, kLongestText) != published_pvd(run_folder, item.target))) {
      problems.push_back(fmt::format("the content of {} has changed", item.name));
    }
  }
  return problems;
}

void give(const fs::path& run_folder, const StageRecord& record, RunLock& lock,
          const Notice& notice) {
  for (const std::string& name : record.give) {
    const std::string text =
        read_file(result_folder(run_folder, record.stage, record.key) / name, kLongestText);
    const std::string digest = sha256(text);
    const auto former = lock.given.find(name);
    const std::optional<std::string> now = present_digest(run_folder, name);
    if (now && *now != digest && (former == lock.given.end() || *now != former->second)) {
      notice(
          fmt::format("{} was changed and is kept as it is (remove it to get that of the "
                      "program)",
                      name));
      continue;
    }
    if (!now) make_folders((run_folder / name).parent_path());
    if (now != digest) write_file(run_folder / name, text);
    lock.given[name] = digest;
  }
}

}  // namespace flowslide
