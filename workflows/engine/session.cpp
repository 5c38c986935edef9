#include "workflows/engine/session.hpp"

#include "core/check.hpp"
#include "core/files.hpp"
#include "workflows/engine/sealed_json.hpp"

#include <algorithm>

namespace fs = std::filesystem;

namespace flowslide {
namespace {

/// Name of an entry through which something outside the folder could be written.
std::optional<std::string> way_out(const fs::path& folder) {
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    const bool plain =
        !entry.is_symlink() &&
        (entry.is_directory() || (entry.is_regular_file() && entry.hard_link_count() == 1));
    if (!plain) return entry.path().lexically_relative(folder).generic_string();
  }
  return std::nullopt;
}

/// Files may be older than 1970.
std::int64_t time_from(const Json& json) {
  validate(json.is_number_integer(), "{} is no time", json.dump());
  return json.get<std::int64_t>();
}

Session session_from(const Json& json) {
  Session session{.seconds = json.at("seconds"), .inputs = {}, .ended = json.at("ended")};
  for (const Json& i : json.at("inputs"))
    session.inputs.push_back({.inode = whole_number(i.at("inode")),
                              .size = whole_number(i.at("bytes")),
                              .modified = time_from(i.at("modified_ns")),
                              .changed = time_from(i.at("changed_ns"))});
  return session;
}

}  // namespace

void write_session(const fs::path& work, double seconds, std::span<const HashedFile> inputs,
                   bool ended) {
  Json list = Json::array();
  for (const HashedFile& file : inputs)
    list.push_back({{"inode", file.state.inode},
                    {"bytes", file.state.size},
                    {"modified_ns", file.state.modified},
                    {"changed_ns", file.state.changed}});
  write_file(work / kSessionFile, seal({{"seconds", seconds}, {"ended", ended}, {"inputs", list}}));
}

SessionRead read_session(const fs::path& work) {
  const fs::file_type type = own_type_of(work);
  if (type == fs::file_type::not_found) return {};
  if (type != fs::file_type::directory) return {{}, "its folder is none"};
  if (const auto name = way_out(work)) return {{}, fmt::format("{} is a link or no file", *name)};
  const SealedJson file = read_sealed(work / kSessionFile);
  if (!file.json)
    return {{}, file.problem.empty() ? fmt::format("{} is missing", kSessionFile) : file.problem};
  try {
    return {session_from(*file.json), {}};
  } catch (const Json::exception& e) {
    return {{}, fmt::format("{} cannot be used ({})", kSessionFile, e.what())};
  } catch (const InputError& e) {
    return {{}, fmt::format("{} cannot be used ({})", kSessionFile, e.what())};
  }
}

bool is_touched(const Session& session, std::span<const HashedFile> inputs) {
  if (session.ended) return false;
  return !std::equal(
      inputs.begin(), inputs.end(), session.inputs.begin(), session.inputs.end(),
      [](const HashedFile& now, const FileState& then) { return now.state == then; });
}

}  // namespace flowslide
