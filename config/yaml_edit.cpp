#include "config/yaml_data.hpp"

#include <algorithm>
#include <charconv>

#include <fmt/format.h>

namespace flowslide::yaml {
namespace {

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

/// The item a path names by its number; null if the text is no number or the list is shorter.
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

bool is_reference(std::string_view text) { return text.find("${") != std::string_view::npos; }

Tree find_target(const Tree& root, const YamlNode::Data& from, const std::string& target) {
  const auto fail = [&](const std::string& text) {
    return error_at(from.where, from.path_text(), fmt::format("'{}': {}", from.scalar, text));
  };
  const auto keys = split_path(target);
  if (!is_path(keys)) throw fail("is not a path (keys are separated by single dots)");
  Tree node = root;
  for (const std::string& key : keys) {
    const std::string path = node->path ? node->path_text() : "the file";
    if (node->kind == Kind::scalar) throw fail(no_key(path, *node, key));
    Tree child = node->kind == Kind::list ? item(*node, key) : node->find(key);
    if (!child && node->kind == Kind::list) throw fail(no_item(path, *node, key));
    if (!child) {
      std::vector<std::string> known;
      for (const auto& [name, unused] : node->entries) known.push_back(name);
      const auto near = nearest(key, known);
      throw fail(
          fmt::format("{} has no key '{}' (a reference needs a value that is written there)"
                      "{}",
                      path, key, near ? fmt::format(" did you mean '{}'?", *near) : ""));
    }
    node = child;
  }
  if (node->kind != Kind::scalar)
    throw fail(fmt::format("{} is {} (only a single value can be referred to)", node->path_text(),
                           name(node->kind)));
  return node;
}

constexpr std::size_t kMaxChain = 8;

void resolve(const Tree& root, YamlNode::Data& node, std::vector<const YamlNode::Data*>& chain) {
  if (!is_reference(node.scalar)) return;
  const std::string written = node.scalar;
  if (!written.starts_with("${") || written.find('}') != written.size() - 1)
    throw error_at(node.where, node.path_text(),
                   fmt::format("'{}' holds a reference within text (a reference is the whole "
                               "value) write '${{path.to.key}}' alone",
                               written));
  chain.push_back(&node);
  const Tree target = find_target(root, node, written.substr(2, written.size() - 3));
  if (std::find(chain.begin(), chain.end(), target.get()) != chain.end()) {
    std::string circle;
    for (const auto* link : chain) circle += link->path_text() + " -> ";
    throw error_at(node.where, node.path_text(),
                   fmt::format("'{}' refers to itself ({}{}) give one of them a value", written,
                               circle, target->path_text()));
  }
  if (chain.size() > kMaxChain)
    throw error_at(node.where, node.path_text(),
                   fmt::format("'{}' ends a chain of more than {} references (hard to follow) "
                               "refer to the value itself",
                               written, kMaxChain));
  resolve(root, *target, chain);
  chain.pop_back();
  node.scalar = target->scalar;
  node.reference = written;
}

void resolve_below(const Tree& root, const Tree& node) {
  std::vector<const YamlNode::Data*> chain;
  if (node->kind == Kind::scalar) resolve(root, *node, chain);
  for (const Tree& child : node->items) resolve_below(root, child);
  for (const auto& [key, child] : node->entries) resolve_below(root, child);
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

void resolve_references(const Tree& root) { resolve_below(root, root); }

}  // namespace flowslide::yaml
