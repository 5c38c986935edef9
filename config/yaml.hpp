#pragma once
#include "config/schema.hpp"
#include "core/nearest.hpp"

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

/// Strict YAML with locations. Only the files yaml*.cpp know the YAML library.
namespace flowslide {

/// A place in a workflow file, or the --set option that put the value there.
struct Where {
  std::string file;
  int line = 0;                            ///< from 1; 0 for values given by --set
  int column = 0;                          ///< from 1
  [[nodiscard]] std::string text() const;  ///< "case.yaml:14:7" or "--set stages.map...=..."
};

/// A value in a YAML document; cheap to copy, keeps the document alive.
class YamlNode {
 public:
  enum class Kind { scalar, list, map, null };
  [[nodiscard]] Kind kind() const;
  [[nodiscard]] Where where() const;
  /// Place of the key of a map entry; of anything else the place itself.
  [[nodiscard]] Where key_where() const;
  [[nodiscard]] std::string path() const;  ///< "stages.map.with.seed"
  /// Folder of the file, against which relative paths in it are resolved; empty: working directory.
  [[nodiscard]] const std::filesystem::path& folder() const;
  [[nodiscard]] const std::string& scalar() const;       ///< throws InputError if not a scalar
  [[nodiscard]] std::size_t size() const;                ///< of a list or map, else 0
  [[nodiscard]] YamlNode item(std::size_t index) const;  ///< throws InputError if not there
  /// Entries of a map in file order; throws InputError (with location) if not a map.
  [[nodiscard]] std::vector<std::pair<std::string, YamlNode>> entries() const;
  /// Empty if there is no such key; throws InputError for a list or a scalar.
  [[nodiscard]] std::optional<YamlNode> find(std::string_view key) const;
  /// "file:line:column: path: <text>"
  [[nodiscard]] InputError error(std::string_view text) const;

  struct Data;

 private:
  friend YamlNode load_yaml(const std::filesystem::path&, std::span<const std::string>);
  explicit YamlNode(std::shared_ptr<const Data> data) : data_(std::move(data)) {}
  std::shared_ptr<const Data> data_;
};

/// Parses one document. Refuses duplicate keys, aliases, anchors and tags, several documents, an
/// empty document, tabs and text that is not UTF-8, nesting deeper than 64.
/// `overrides` are "path.to.key=value" texts of --set; the value is parsed as YAML and may create
/// keys that are absent, `null` removes the key, items of lists are numbered from 0 ("list.0.key").
/// Afterwards a scalar that is exactly "${path.to.key}" is replaced by what stands at that absolute
/// path, a single value, a list or a map (no chains deeper than 8, a cycle is an error).
/// Throws InputError with location, FileError.
YamlNode load_yaml(const std::filesystem::path& path, std::span<const std::string> overrides = {});

namespace detail {
void read_fields(const std::optional<YamlNode>& node, std::string_view path,
                 const std::function<void(FieldVisitor&)>& describe);
}  // namespace detail

/// Reads settings with Schema<T>. `node` empty means "nothing given"; `path` is where it would
/// stand. Every unknown key, missing required value, wrong unit or value out of range is an
/// InputError with its location; unknown keys suggest the nearest known one. Up to 20 problems are
/// reported at once, one per line. A key without a value is an error, except for groups, lists and
/// tables, where it means an empty one. Relative InputFile paths are resolved against the folder of
/// the YAML file; whether the file exists is not checked.
template <class T>
T read_settings(const std::optional<YamlNode>& node, std::string_view path) {
  T settings{};
  detail::read_fields(node, path, [&](FieldVisitor& v) { Schema<T>::describe(v, settings); });
  return settings;
}

}  // namespace flowslide
