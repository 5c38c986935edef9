#include "config/yaml.hpp"

#include "config/yaml_data.hpp"

#include <array>

#include <fmt/format.h>

namespace flowslide {
namespace yaml {

std::string_view name(YamlNode::Kind kind) {
  constexpr std::array<std::string_view, 4> names = {"a single value", "a list", "a map",
                                                     "without a value"};
  return names[static_cast<std::size_t>(kind)];
}

std::string join(std::string_view path, std::string_view key) {
  return path.empty() ? std::string(key) : fmt::format("{}.{}", path, key);
}

InputError error_at(const Place& place, std::string_view path, std::string_view text) {
  const std::string where = place.where().text();
  if (path.empty()) return InputError(fmt::format("{}: {}", where, text));
  return InputError(fmt::format("{}: {}: {}", where, path, text));
}

std::string Path::text() const { return join(above ? above->text() : "", key); }

void set_paths(const Tree& node, const std::shared_ptr<const Path>& path,
               const std::shared_ptr<const std::filesystem::path>& folder) {
  node->path = path;
  node->folder = folder;
  const auto below = [&](std::string key) {
    return std::make_shared<const Path>(Path{path, std::move(key)});
  };
  for (std::size_t i = 0; i < node->items.size(); ++i)
    set_paths(node->items[i], below(std::to_string(i)), folder);
  for (const auto& [key, child] : node->entries) set_paths(child, below(key), folder);
}

}  // namespace yaml

std::string Where::text() const {
  return line > 0 ? fmt::format("{}:{}:{}", file, line, column) : file;
}

std::shared_ptr<YamlNode::Data> YamlNode::Data::find(std::string_view key) const {
  const auto found = index.find(key);
  return found == index.end() ? nullptr : entries[found->second].second;
}

void YamlNode::Data::append(const std::string& key, std::shared_ptr<Data> child) {
  index.emplace(key, entries.size());
  entries.emplace_back(key, std::move(child));
}

void YamlNode::Data::erase(const std::string& key) {
  std::erase_if(entries, [&](const auto& entry) { return entry.first == key; });
  index.clear();
  for (std::size_t i = 0; i < entries.size(); ++i) index.emplace(entries[i].first, i);
}

YamlNode::Kind YamlNode::kind() const { return data_->kind; }
Where YamlNode::where() const { return data_->where.where(); }
Where YamlNode::key_where() const { return data_->key_where.where(); }
std::string YamlNode::path() const { return data_->path_text(); }
const std::filesystem::path& YamlNode::folder() const { return *data_->folder; }

const std::string& YamlNode::scalar() const {
  if (kind() != Kind::scalar)
    throw error(fmt::format("is {} (a single value is expected)", yaml::name(kind())));
  return data_->scalar;
}

std::size_t YamlNode::size() const {
  return kind() == Kind::list ? data_->items.size() : data_->entries.size();
}

YamlNode YamlNode::item(std::size_t index) const {
  if (kind() != Kind::list)
    throw error(fmt::format("is {} (a list is expected)", yaml::name(kind())));
  if (index >= size())
    throw error(fmt::format("has no item {} (the list has {} items)", index, size()));
  return YamlNode(data_->items[index]);
}

std::vector<std::pair<std::string, YamlNode>> YamlNode::entries() const {
  if (kind() != Kind::map)
    throw error(
        fmt::format("is {} (a map is expected) write 'key: value' lines", yaml::name(kind())));
  std::vector<std::pair<std::string, YamlNode>> all;
  for (const auto& [key, child] : data_->entries) all.emplace_back(key, YamlNode(child));
  return all;
}

std::optional<YamlNode> YamlNode::find(std::string_view key) const {
  if (kind() == Kind::null) return std::nullopt;
  if (kind() != Kind::map)
    throw error(
        fmt::format("is {} (a map is expected) write 'key: value' lines", yaml::name(kind())));
  if (auto child = data_->find(key)) return YamlNode(child);
  return std::nullopt;
}

InputError YamlNode::error(std::string_view text) const {
  if (data_->reference.empty()) return yaml::error_at(data_->where, path(), text);
  return yaml::error_at(data_->where, path(),
                        fmt::format("{} (the value comes from {})", text, data_->reference));
}

YamlNode load_yaml(const std::filesystem::path& path, std::span<const std::string> overrides) {
  const yaml::Source source(path.string());
  const yaml::Tree root = yaml::parse(yaml::clean_text(yaml::read_text(path), source), source);
  for (const std::string& option : overrides) yaml::apply_override(root, option);
  yaml::set_paths(root, nullptr, std::make_shared<std::filesystem::path>(path.parent_path()));
  yaml::resolve_references(root);
  return YamlNode(root);
}

}  // namespace flowslide
