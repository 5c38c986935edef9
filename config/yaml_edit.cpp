#include "config/yaml_data.hpp"

#include <algorithm>
#include <charconv>

#include <fmt/format.h>

namespace flowslide::yaml {

using Kind = YamlNode::Kind;

std::vector<std::string> split_path(std::string_view path) {
  std::vector<std::string> keys;
  for (std::size_t start = 0;;) {
    const auto dot = path.find('.', start);
    keys.emplace_back(path.substr(start, dot - start));
    if (dot == std::string_view::npos) return keys;
    start = dot + 1;
  }
}

bool is_path(const std::vector<std::string>& keys) {
  return keys.size() <= kMaxDepth &&
         std::none_of(keys.begin(), keys.end(), [](const std::string& k) { return k.empty(); });
}

Tree item(const YamlNode::Data& list, const std::string& key) {
  std::size_t index = 0;
  const auto [end, error] = std::from_chars(key.data(), key.data() + key.size(), index);
  if (error != std::errc() || end != key.data() + key.size()) return nullptr;
  return index < list.items.size() ? list.items[index] : nullptr;
}

std::string no_item(std::string_view path, const YamlNode::Data& list, const std::string& key) {
  return fmt::format("{} has no item '{}' (it is a list of {}) number its items from 0", path, key,
                     list.items.size());
}

std::string no_key(std::string_view path, const YamlNode::Data& scalar, const std::string& key) {
  return fmt::format("{} is the single value '{}' (it cannot have a key '{}')", path, scalar.scalar,
                     key);
}

namespace {

/// One step down a path for writing: creates what is missing.
Tree step(const Tree& node, const std::string& path, const std::string& key, const Place& where) {
  if (node->kind == Kind::scalar) throw error_at(where, "", no_key(path, *node, key));
  if (node->kind == Kind::list) {
    if (Tree child = item(*node, key)) return child;
    throw error_at(where, "", no_item(path, *node, key));
  }
  node->kind = Kind::map;
  if (Tree child = node->find(key)) return child;
  auto child = std::make_shared<YamlNode::Data>();
  child->where = where;
  child->key_where = where;
  node->append(key, child);
  return child;
}

void remove(const Tree& root, const std::vector<std::string>& keys) {
  Tree node = root;
  for (std::size_t i = 0; i + 1 < keys.size() && node; ++i)
    node = node->kind == Kind::list ? item(*node, keys[i]) : node->find(keys[i]);
  if (node) node->erase(keys.back());
}

/// As much of an option as a message needs to tell which one it is.
std::string shortened(std::string_view option) {
  constexpr std::size_t kShown = 200;
  if (option.size() <= kShown) return std::string(option);
  std::size_t end = kShown;
  while (end > 0 && (static_cast<unsigned char>(option[end]) & 0xC0U) == 0x80U) --end;
  return std::string(option.substr(0, end)) + "...";
}

}  // namespace

void apply_override(const Tree& root, std::string_view option) {
  const Source source(fmt::format("--set {}", shortened(option)), false);
  const auto equals = option.find('=');
  const auto keys = split_path(option.substr(0, equals));
  if (equals == std::string_view::npos || !is_path(keys))
    throw error_at(source.at(0, 0), "",
                   "is not of the form path.to.key=value (e.g. --set stages.flow.with.cell='1 m')");
  const std::string text = clean_text(option.substr(equals + 1), source);
  if (text == "null" || text == "~") {
    remove(root, keys);
    return;
  }
  const Tree value = parse(text, source);
  Tree node = root;
  std::string path;
  for (const std::string& key : keys) {
    node = step(node, path.empty() ? "the file" : path, key, source.at(0, 0));
    path = join(path, key);
  }
  const Place key_where = node->key_where;
  *node = *value;
  node->key_where = key_where;
}

}  // namespace flowslide::yaml
