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

struct YamlNode::Data {
  Kind kind = Kind::null;
  Where where;
  Where key_where;
  std::string path;
  std::string scalar;
  std::string reference;  ///< "${path}" if the scalar was taken from there
  std::shared_ptr<const std::filesystem::path> folder;
  std::vector<std::shared_ptr<Data>> items;
  std::vector<std::pair<std::string, std::shared_ptr<Data>>> entries;
  std::map<std::string, std::size_t, std::less<>> index;  ///< of the keys of `entries`

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
  std::string name;
  bool has_lines = true;
  [[nodiscard]] Where at(int line, int column) const;
  [[nodiscard]] Where at_byte(std::string_view text, std::size_t byte) const;
};

/// Content of a file. Throws FileError; InputError if it is too large for a settings file.
std::string read_text(const std::filesystem::path& path);

/// The text without byte-order mark and with '\n' as line end. Throws InputError for anything that
/// is not UTF-8 text without tabs and control characters.
std::string clean_text(std::string_view bytes, const Source& source);

/// Parses one document; `paths` are not set yet. Throws InputError.
Tree parse(const std::string& text, const Source& source);

/// Applies one --set option. Throws InputError.
void apply_override(const Tree& root, std::string_view option);

/// Replaces scalars "${path}" by the scalar at the path. Throws InputError.
void resolve_references(const Tree& root);

/// Sets path and folder of every node.
void set_paths(const Tree& node, const std::string& path,
               const std::shared_ptr<const std::filesystem::path>& folder);

/// "file:line:column: path: text"
InputError error_at(const Where& where, std::string_view path, std::string_view text);

}  // namespace yaml
}  // namespace flowslide
