#include "workflows/engine/stage.hpp"

#include "core/check.hpp"
#include "core/unreadable.hpp"

#include <fmt/format.h>

namespace flowslide::detail {
namespace {

/// The setting that a path names, or the last one above it that is written; what was passed is
/// taken off the path.
YamlNode follow(YamlNode node, std::string_view& path) {
  while (!path.empty() && node.kind() == YamlNode::Kind::map) {
    const std::string_view key = path.substr(0, path.find('.'));
    const auto child = node.find(key.starts_with('"') ? key.substr(1, key.size() - 2) : key);
    if (!child) break;
    node = *child;
    path.remove_prefix(std::min(key.size() + 1, path.size()));
  }
  return node;
}

/// In which folder a name was looked for, and why there.
std::string where_looked(const YamlNode& node, const std::filesystem::path& file) {
  std::error_code error;
  const std::filesystem::path folder = std::filesystem::absolute(file, error).parent_path();
  if (error) return {};
  const Where where = node.where();
  return fmt::format(
      " (looked for in {}: {})", folder.lexically_normal().string(),
      where.line > 0 ? fmt::format("names in {} are relative to its folder",
                                   std::filesystem::path(where.file).filename().string())
                     : "names in --set are relative to the folder in which the program is started");
}

}  // namespace

InputError locate(const YamlNode& settings, std::string_view text) {
  const std::string_view word = text.substr(0, text.find(' '));
  const bool named = word.ends_with(':');
  if (word.size() == text.size() || (!named && word.find('.') == std::string_view::npos))
    return settings.error(text);
  std::string_view rest = named ? word.substr(0, word.size() - 1) : word;
  const YamlNode node = follow(settings, rest);
  const std::size_t passed = rest.empty() ? word.size() + 1 : word.size() - rest.size() - named;
  return node.error(text.substr(passed));
}

FileError locate_file(const YamlNode& settings, std::string_view text) {
  const std::size_t colon = text.find(": ");
  if (colon == std::string_view::npos) return FileError(settings.error(text).what());
  std::string_view path = text.substr(0, colon);
  const YamlNode node = follow(settings, path);
  // A default, or an entry of a list: the place of what is written above it.
  if (node.kind() != YamlNode::Kind::scalar) return FileError(node.error(text).what());
  const std::filesystem::path file = (node.folder() / node.scalar()).lexically_normal();
  std::string why = why_unreadable(file);
  if (why.starts_with("no such file") && std::filesystem::path(node.scalar()).is_relative() &&
      why.find('~') == std::string::npos)
    why += where_looked(node, file);
  if (why.empty()) return FileError(node.error(text.substr(colon + 2)).what());
  return FileError(node.error(fmt::format("{}: {}", file.string(), why)).what());
}

}  // namespace flowslide::detail
