#include "workflows/engine/stage.hpp"

#include "core/check.hpp"
#include "core/unreadable.hpp"

#include <fmt/format.h>

namespace flowslide::detail {

FileError locate_file(const YamlNode& settings, std::string_view text) {
  const std::size_t colon = text.find(": ");
  if (colon == std::string_view::npos) return FileError(settings.error(text).what());
  std::string_view path = text.substr(0, colon);
  YamlNode node = settings;
  while (!path.empty() && node.kind() == YamlNode::Kind::map) {
    const std::string_view key = path.substr(0, path.find('.'));
    const auto child = node.find(key.starts_with('"') ? key.substr(1, key.size() - 2) : key);
    if (!child) break;
    node = *child;
    path.remove_prefix(std::min(key.size() + 1, path.size()));
  }
  // A default, or an entry of a list: the place of what is written above it.
  if (node.kind() != YamlNode::Kind::scalar) return FileError(node.error(text).what());
  const std::filesystem::path file = node.folder() / node.scalar();
  const std::string why = why_unreadable(file);
  if (why.empty()) return FileError(node.error(text.substr(colon + 2)).what());
  return FileError(node.error(fmt::format("{}: {}", file.lexically_normal().string(), why)).what());
}

}  // namespace flowslide::detail
