#pragma once
#include "config/yaml.hpp"

#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

/// The document behind YamlNode, as the files yaml*.cpp build it.
namespace flowslide {
namespace yaml {

/// A Where whose name is shared by all nodes of a document.
struct Place {
  std::shared_ptr<const std::string> file;
  int line = 0, column = 0;
  [[nodiscard]] Where where() const { return {file ? *file : "", line, column}; }
};

/// The way from the top to a node. The text is made when it is asked for: that of every node of a
/// document with long keys would be the square of the document.
struct Path {
  std::shared_ptr<const Path> above;  ///< null: at the top
  std::string key;
  [[nodiscard]] std::string text() const;
};

}  // namespace yaml

struct YamlNode::Data {
  Kind kind = Kind::null;
  yaml::Place where;
  yaml::Place key_where;
  std::shared_ptr<const yaml::Path> path;  ///< null: the document itself
  std::string scalar;
  std::string reference;  ///< "${path}" if the value was taken from there
  std::shared_ptr<const std::filesystem::path> folder;
  std::vector<std::shared_ptr<Data>> items;
  std::vector<std::pair<std::string, std::shared_ptr<Data>>> entries;
  std::map<std::string, std::size_t, std::less<>> index;  ///< of the keys of `entries`

  [[nodiscard]] std::string path_text() const { return path ? path->text() : ""; }
  [[nodiscard]] std::shared_ptr<Data> find(std::string_view key) const;
  void append(const std::string& key, std::shared_ptr<Data> child);
  void erase(const std::string& key);
};

namespace yaml {

using Tree = std::shared_ptr<YamlNode::Data>;

/// Deeper nesting is refused, so that recursion over a document is bounded.
inline constexpr int kMaxDepth = 64;

std::string_view name(YamlNode::Kind kind);
std::string join(std::string_view path, std::string_view key);

/// Where a text comes from: a file, whose places have lines, or a --set option.
struct Source {
  explicit Source(std::string text, bool lines = true)
      : name(std::make_shared<std::string>(std::move(text))), has_lines(lines) {}
  std::shared_ptr<const std::string> name;
  bool has_lines;
  [[nodiscard]] Place at(int line, int column) const;
  [[nodiscard]] Place at_byte(std::string_view text, std::size_t byte) const;
};

/// Content of a file. Throws FileError; InputError if it is too large for a settings file.
std::string read_text(const std::filesystem::path& path);

/// The text without byte-order mark and with '\n' as line end. Throws InputError for anything that
/// is not UTF-8 text without tabs and control characters.
std::string clean_text(std::string_view bytes, const Source& source);

/// Parses one document; `paths` are not set yet. Throws InputError.
Tree parse(const std::string& text, const Source& source);

/// Keys of "path.to.key"; is_path() tells whether all of them say something.
std::vector<std::string> split_path(std::string_view path);
bool is_path(const std::vector<std::string>& keys);
/// The item a path names by its number; null if the text is no number or the list is shorter.
Tree item(const YamlNode::Data& list, const std::string& key);
/// Why a path does not go on at a list without that item, and at a single value.
std::string no_item(std::string_view path, const YamlNode::Data& list, const std::string& key);
std::string no_key(std::string_view path, const YamlNode::Data& scalar, const std::string& key);

/// Applies one --set option. Throws InputError.
void apply_override(const Tree& root, std::string_view option);

/// Replaces scalars "${path}" by what stands at the path: a single value, a list or a map. Needs
/// the paths, and sets those of what it copies. Throws InputError.
void resolve_references(const Tree& root);

/// Sets path and folder of every node.
void set_paths(const Tree& node, const std::shared_ptr<const Path>& path,
               const std::shared_ptr<const std::filesystem::path>& folder);

/// "file:line:column: path: text"
InputError error_at(const Place& place, std::string_view path, std::string_view text);

}  // namespace yaml
}  // namespace flowslide
