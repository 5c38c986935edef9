#include "workflows/engine/unknown_key.hpp"

#include <algorithm>
#include <functional>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace flowslide {
namespace {

/// What a key that has no effect was meant to be; empty if nothing suggests itself.
using Meant = std::function<std::string(const std::string& key, const YamlNode& value)>;

void refuse(const YamlNode& map, const std::vector<std::string>& known, const Meant& meant) {
  for (const auto& [key, value] : map.entries()) {
    if (std::find(known.begin(), known.end(), key) != known.end()) continue;
    const std::string path = meant(key, value);
    throw value.error(fmt::format(
        "unknown key '{}' (it would have no effect). {}", key,
        path.empty() ? did_you_mean(key, known) : fmt::format("Did you mean '{}'?", path)));
  }
}

/// Keys of a --set option below a node, which they alone have made: ".with.cell".
std::string written_below(YamlNode node) {
  std::string path;
  while (node.kind() == YamlNode::Kind::map && node.size() == 1) {
    const auto entry = node.entries().front();
    path += "." + entry.first;
    node = entry.second;
  }
  return path;
}

bool is_override(const YamlNode& node) { return node.key_where().line == 0; }

/// The path of a setting of a stage from what was written behind the stage's name.
std::string setting(const std::string& stage, const std::string& below) {
  const bool with = below == ".with" || below.starts_with(".with.");
  return "stages." + stage + (with ? "" : ".with") + below;
}

}  // namespace

std::string did_you_mean(std::string_view word, const std::vector<std::string>& known) {
  const auto near = nearest(word, known);
  return near ? fmt::format("Did you mean '{}'?", *near)
              : fmt::format("Known: {}.", fmt::join(known, ", "));
}

void refuse_unknown_keys(const YamlNode& map, const std::vector<std::string>& known) {
  refuse(map, known, [](const std::string&, const YamlNode&) { return std::string(); });
}

void refuse_unknown_top_keys(const YamlNode& document, const std::vector<std::string>& known) {
  std::vector<std::string> names;
  const auto stages = document.find("stages");
  if (stages && stages->kind() == YamlNode::Kind::map)
    for (const auto& [name, stage] : stages->entries()) names.push_back(name);
  refuse(document, known, [&](const std::string& key, const YamlNode& value) {
    const bool exact = std::find(names.begin(), names.end(), key) != names.end();
    const std::optional<std::string> stage = exact                 ? std::optional(key)
                                             : nearest(key, known) ? std::nullopt
                                                                   : nearest(key, names);
    if (!stage) return std::string();
    return is_override(value) ? setting(*stage, written_below(value)) : "stages." + *stage;
  });
}

void refuse_unknown_stage_keys(const YamlNode& stage, const std::vector<std::string>& known) {
  const std::string name = stage.path().substr(stage.path().rfind('.') + 1);
  refuse(stage, known, [&](const std::string& key, const YamlNode& value) {
    if (nearest(key, known)) return std::string();
    return setting(name, "." + key + (is_override(value) ? written_below(value) : ""));
  });
}

}  // namespace flowslide
