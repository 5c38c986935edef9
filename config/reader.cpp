#include "config/read_value.hpp"
#include "config/yaml.hpp"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace flowslide {
namespace {

/// Reads the fields a Schema declares. A problem is noted and reading goes on, so that a user sees
/// all problems of a file at once.
class SettingsReader final : public FieldVisitor {
 public:
  SettingsReader(const std::optional<YamlNode>& node, std::string_view path) {
    Frame frame{.path = node ? node->path() : std::string(path)};
    visit_map(frame, node);
    frames_.push_back(std::move(frame));
  }

  [[nodiscard]] bool visits() const { return frames_.back().visited; }

  /// Throws what was noted.
  void finish() {
    end_group();
    if (count_ == 0) return;
    std::stable_sort(problems_.begin(), problems_.end(),
                     [](const Problem& a, const Problem& b) { return a.line < b.line; });
    std::string text;
    for (std::size_t i = 0; i < std::min(problems_.size(), kMaxShown); ++i)
      text += (i == 0 ? "" : "\n") + problems_[i].text;
    if (count_ > kMaxShown) text += fmt::format("\nand {} more problems", count_ - kMaxShown);
    throw InputError(text);
  }

  void quantity(std::string_view key, double& value, Dim dim, Range range,
                std::string_view doc) override {
    field(key, !is_set(value), example(dim), doc,
          [&](const YamlNode& node) { value = read_quantity(node, dim, range); });
  }
  void quantity(std::string_view key, std::optional<double>& value, Dim dim, Range range,
                std::string_view doc) override {
    field(key, false, {}, doc,
          [&](const YamlNode& node) { value = read_quantity(node, dim, range); });
  }
  void integer(std::string_view key, int& value, Range range, std::string_view doc) override {
    field(key, !range.contains(value), "1", doc,
          [&](const YamlNode& node) { value = read_integer(node, range); });
  }
  void flag(std::string_view key, bool& value, std::string_view doc) override {
    field(key, false, {}, doc, [&](const YamlNode& node) { value = read_flag(node); });
  }
  void text(std::string_view key, std::string& value, std::string_view doc) override {
    field(key, value.empty(), "<text>", doc,
          [&](const YamlNode& node) { value = read_text(node); });
  }
  void text(std::string_view key, std::optional<std::string>& value,
            std::string_view doc) override {
    field(key, false, {}, doc, [&](const YamlNode& node) { value = read_text(node); });
  }
  void file(std::string_view key, InputFile& value, std::string_view doc) override {
    field(key, value.path.empty(), "<file>", doc,
          [&](const YamlNode& node) { value = read_file(node); });
  }
  void file(std::string_view key, std::optional<InputFile>& value, std::string_view doc) override {
    field(key, false, {}, doc, [&](const YamlNode& node) { value = read_file(node); });
  }

  void tuple(std::string_view key, std::span<double> values, Dim dim,
             std::string_view doc) override {
    bool unset = false;
    for (const double value : values) unset = unset || !is_set(value);
    const std::vector<std::string> items(values.size(), example(dim));
    field(key, unset, fmt::format("[{}]", fmt::join(items, ", ")), doc, [&](const YamlNode& node) {
      expect_list(node);
      if (node.size() != values.size())
        throw node.error(fmt::format("has {} values ({} are expected, e.g. [{}])", node.size(),
                                     values.size(), fmt::join(items, ", ")));
      each(node, [&](std::size_t i) { values[i] = read_quantity(node.item(i), dim, {}); });
    });
  }
  void numbers(std::string_view key, std::vector<double>& values, Dim dim,
               std::string_view doc) override {
    items(key, values, doc, [dim](const YamlNode& item) { return read_quantity(item, dim, {}); });
  }
  void integers(std::string_view key, std::vector<int>& values, std::string_view doc) override {
    items(key, values, doc, [](const YamlNode& item) { return read_integer(item, {}); });
  }
  void texts(std::string_view key, std::vector<std::string>& values,
             std::string_view doc) override {
    items(key, values, doc, [](const YamlNode& item) { return read_text(item); });
  }
  void rows(std::string_view key, std::vector<std::vector<double>>& values,
            std::span<const Column> columns, std::string_view doc) override {
    items(key, values, doc, [&](const YamlNode& row) { return read_row(row, columns); });
  }

  void moved(std::string_view key, std::string_view text, Moved what) override {
    Frame& frame = frames_.back();
    const auto node = frame.node ? frame.node->find(key) : std::nullopt;
    if (!node || (what == Moved::list && node->kind() != YamlNode::Kind::list)) return;
    frame.refused.emplace_back(key);
    note(node->key_where().line,
         fmt::format("{}: {}: '{}' is written as in an older version {}", node->key_where().text(),
                     frame.path.empty() ? "the file" : frame.path, key, text));
  }
  void passed_over(std::string_view key) override { frames_.back().known.emplace_back(key); }

 protected:
  void choice_index(std::string_view key, int& index, std::span<const std::string_view> names,
                    std::string_view doc) override {
    field(key, false, {}, doc, [&](const YamlNode& node) { index = read_choice(node, names); });
  }

  bool begin_group(std::string_view key, Presence presence, std::string_view) override {
    const auto node = take(key);
    Frame frame{.path = child_path(key)};
    if (has(frames_.back().refused, key)) {
      frames_.push_back(std::move(frame));
      return false;
    }
    if (presence == Presence::absent && node && node->kind() == YamlNode::Kind::null)
      note(*node,
           node->error("has no value (is it wanted or not?) remove the key, or write '{}' for its "
                       "defaults"));
    else if (presence != Presence::absent || node)
      visit_map(frame, node);
    frames_.push_back(std::move(frame));
    return visits();
  }

  void end_group() override {
    const Frame& frame = frames_.back();
    if (frame.visited && frame.node) {
      for (const auto& [key, value] : frame.node->entries())
        if (!has(frame.known, key) && !has(frame.refused, key)) note_unknown(key, value, frame);
    }
    frames_.pop_back();
  }

  std::size_t begin_list(std::string_view key, std::size_t size, std::string_view) override {
    const auto node = take(key);
    Frame frame{.path = child_path(key), .given = node.has_value()};
    if (node) {
      size = 0;
      try {
        if (node->kind() != YamlNode::Kind::null) {
          expect_list(*node);
          frame.node = node;
          size = node->size();
        }
      } catch (const InputError& e) {
        note(*node, e);
      }
    }
    frames_.push_back(std::move(frame));
    return size;
  }
  bool begin_item(std::size_t index) override {
    const Frame& list = frames_.back();
    Frame frame{.path = fmt::format("{}.{}", list.path, index)};
    visit_map(frame, list.node ? std::optional(list.node->item(index)) : std::nullopt);
    frames_.push_back(std::move(frame));
    return visits();
  }
  void end_list() override { frames_.pop_back(); }

  std::vector<std::string> begin_table(std::string_view key, const std::vector<std::string>& names,
                                       std::string_view) override {
    const auto node = take(key);
    Frame frame{.path = child_path(key), .given = node.has_value()};
    visit_map(frame, node);
    std::vector<std::string> entries = node ? std::vector<std::string>{} : names;
    if (frame.node)
      for (const auto& [name, unused] : frame.node->entries()) entries.push_back(name);
    frames_.push_back(std::move(frame));
    return entries;
  }
  bool begin_entry(const std::string& name) override {
    const Frame& table = frames_.back();
    Frame frame{.path = fmt::format("{}.{}", table.path, name)};
    visit_map(frame, table.node ? table.node->find(name) : std::nullopt);
    frames_.push_back(std::move(frame));
    return visits();
  }
  void end_table() override { frames_.pop_back(); }

  [[nodiscard]] bool replaces_defaults() const override { return frames_.back().given; }

 private:
  static constexpr std::size_t kMaxShown = 20;
  static constexpr std::size_t kMaxKept = 1000;

  struct Problem {
    int line;  ///< problems are shown in the order of the file
    std::string text;
  };

  struct Frame {
    std::string path = {};
    std::optional<YamlNode> node = {};  ///< empty if the file gives nothing
    bool visited = false;
    bool given = false;  ///< for lists and tables
    std::vector<std::string> known = {};
    std::vector<std::string> refused = {};  ///< keys whose problem is noted
  };

  static bool has(const std::vector<std::string>& keys, std::string_view key) {
    return std::find(keys.begin(), keys.end(), key) != keys.end();
  }

  static std::string example(Dim dim) {
    return dim == Dim::none ? "1" : fmt::format("1 {}", si_unit(dim));
  }

  [[nodiscard]] std::string child_path(std::string_view key) const {
    const std::string& path = frames_.back().path;
    return path.empty() ? std::string(key) : fmt::format("{}.{}", path, key);
  }

  void note(int line, const std::string& text) {
    if (count_++ < kMaxKept) problems_.push_back({line, text});
  }
  void note(const YamlNode& node, const InputError& problem) {
    note(node.where().line, problem.what());
  }

  /// Registers a known key and returns its value, if the file gives one.
  std::optional<YamlNode> take(std::string_view key) {
    Frame& frame = frames_.back();
    frame.known.emplace_back(key);
    return frame.node && !has(frame.refused, key) ? frame.node->find(key) : std::nullopt;
  }

  /// Makes the frame one of a map; nothing given counts as an empty map.
  void visit_map(Frame& frame, const std::optional<YamlNode>& node) {
    frame.visited = true;
    if (!node || node->kind() == YamlNode::Kind::null) {
      if (node) frame.path = node->path();
      return;
    }
    if (node->kind() == YamlNode::Kind::map) {
      frame.node = node;
      return;
    }
    frame.visited = false;
    note(*node, node->error(fmt::format(
                    "is {} (a map is expected) write 'key: value' lines",
                    node->kind() == YamlNode::Kind::list ? "a list" : "a single value")));
  }

  template <class Read>
  void field(std::string_view key, bool required, const std::string& example_text,
             std::string_view doc, Read read) {
    const auto node = take(key);
    if (!node) {
      if (required && !has(frames_.back().refused, key)) note_missing(key, example_text, doc);
      return;
    }
    try {
      if (node->kind() == YamlNode::Kind::null)
        throw node->error("has no value (nothing stands after ':') give one or remove the key");
      read(*node);
    } catch (const InputError& e) {
      note(*node, e);
    }
  }

  template <class Read>
  void each(const YamlNode& list, Read read) {
    for (std::size_t i = 0; i < list.size(); ++i) {
      try {
        read(i);
      } catch (const InputError& e) {
        note(list.item(i), e);
      }
    }
  }

  template <class T, class Read>
  void items(std::string_view key, std::vector<T>& values, std::string_view doc, Read read) {
    field(key, false, {}, doc, [&](const YamlNode& node) {
      expect_list(node);
      values.assign(node.size(), T{});
      each(node, [&](std::size_t i) { values[i] = read(node.item(i)); });
    });
  }

  void note_missing(std::string_view key, const std::string& example_text, std::string_view doc) {
    const std::string text =
        fmt::format("'{}' is missing ({}) add '{}: {}'", key, doc, key, example_text);
    const std::string& path = frames_.back().path;
    const std::string located = path.empty() ? text : fmt::format("{}: {}", path, text);
    for (auto frame = frames_.rbegin(); frame != frames_.rend(); ++frame) {
      if (!frame->node) continue;
      const Where& where = frame->node->key_where();
      note(where.line, fmt::format("{}: {}", where.text(), located));
      return;
    }
    note(0, located);
  }

  void note_unknown(const std::string& key, const YamlNode& value, const Frame& frame) {
    const auto near = nearest(key, frame.known);
    note(value.key_where().line,
         fmt::format("{}: unknown key '{}' in {} (typing error?){} known keys: {}",
                     value.key_where().text(), key, frame.path.empty() ? "the file" : frame.path,
                     near ? fmt::format(" did you mean '{}'?", *near) : "",
                     fmt::join(frame.known, ", ")));
  }

  std::vector<Frame> frames_;
  std::vector<Problem> problems_;
  std::size_t count_ = 0;
};

}  // namespace

void detail::read_fields(const std::optional<YamlNode>& node, std::string_view path,
                         const std::function<void(FieldVisitor&)>& describe) {
  SettingsReader reader(node, path);
  if (reader.visits()) describe(reader);
  reader.finish();
}

}  // namespace flowslide
