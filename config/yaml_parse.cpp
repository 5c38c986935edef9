#include "config/yaml_data.hpp"

#include <sstream>

#include <fmt/format.h>
#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/exceptions.h>
#include <yaml-cpp/parser.h>

namespace flowslide::yaml {
namespace {

using Kind = YamlNode::Kind;

/// Builds the tree from the parser's events and refuses what is legal YAML but a trap for users.
class TreeBuilder final : public YAML::EventHandler {
 public:
  TreeBuilder(const std::string& text, const Source& source) : text_(text), source_(source) {}

  [[nodiscard]] Tree root() const { return root_; }

  void OnDocumentStart(const YAML::Mark& mark) override {
    if (documents_++ > 0)
      throw error_at(at(mark), "",
                     "a second document starts here (one per file is read) remove the '---' line, "
                     "or correct the indentation");
  }
  void OnDocumentEnd() override {}

  void OnAlias(const YAML::Mark& mark, YAML::anchor_t) override {
    throw error_at(at(mark), path(),
                   "alias '*...' (anchors and aliases are not supported) refer to a value with "
                   "${path.to.key}");
  }
  void OnNull(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    refuse_anchor(mark, anchor);
    const Tree node = make(Kind::null, mark);
    if (!stack_.empty() && stack_.back().has_key) node->where = stack_.back().key_where;
    add(node);
  }
  void OnScalar(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                const std::string& value) override {
    refuse_anchor(mark, anchor);
    refuse_tag(mark, tag);
    refuse_open_quote(mark);
    if (expects_key()) {
      take_key(value, at(mark));
      return;
    }
    const Tree node = make(Kind::scalar, mark);
    node->scalar = value;
    add(node);
  }
  void OnSequenceStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                       YAML::EmitterStyle::value) override {
    open(Kind::list, mark, tag, anchor);
  }
  void OnSequenceEnd() override { stack_.pop_back(); }
  void OnMapStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                  YAML::EmitterStyle::value) override {
    open(Kind::map, mark, tag, anchor);
  }
  void OnMapEnd() override { stack_.pop_back(); }

 private:
  struct Level {
    Tree node;
    bool has_key = false;
    std::string key = {};
    Place key_where = {};
  };

  [[nodiscard]] Place at(const YAML::Mark& mark) const {
    return source_.at(mark.line + 1, mark.column + 1);
  }
  [[nodiscard]] bool expects_key() const {
    return !stack_.empty() && stack_.back().node->kind == Kind::map && !stack_.back().has_key;
  }
  [[nodiscard]] std::string path() const {
    std::string text;
    for (const Level& level : stack_) {
      // The levels above the last one already hold the value that is being built.
      const bool last = &level == &stack_.back();
      if (level.node->kind == Kind::list)
        text = join(text, std::to_string(level.node->items.size() - (last ? 0 : 1)));
      else if (!last || level.has_key)
        text = join(text, level.key);
    }
    return text;
  }
  [[nodiscard]] Tree make(Kind kind, const YAML::Mark& mark) const {
    auto node = std::make_shared<YamlNode::Data>();
    node->kind = kind;
    node->where = at(mark);
    node->key_where = node->where;
    return node;
  }

  void refuse_anchor(const YAML::Mark& mark, YAML::anchor_t anchor) const {
    if (anchor != YAML::NullAnchor)
      throw error_at(at(mark), path(),
                     "anchor '&...' (anchors and aliases are not supported) refer to a value with "
                     "${path.to.key}");
  }
  /// The parser reports "?" for plain and "!" for quoted values.
  void refuse_tag(const YAML::Mark& mark, const std::string& tag) const {
    if (!tag.empty() && tag != "?" && tag != "!")
      throw error_at(at(mark), path(),
                     fmt::format("tag '{}' (tags are not supported) remove it", tag));
  }

  /// The library ends a quoted value silently at the end of the text, keys and all.
  void refuse_open_quote(const YAML::Mark& mark) const {
    const auto start = static_cast<std::size_t>(mark.pos);
    if (start >= text_.size() || (text_[start] != '"' && text_[start] != '\'')) return;
    const char quote = text_[start];
    for (std::size_t i = start + 1; i < text_.size(); ++i) {
      if (quote == '"' && text_[i] == '\\') {
        ++i;
      } else if (text_[i] == quote) {
        if (quote == '"' || i + 1 >= text_.size() || text_[i + 1] != quote) return;
        ++i;
      }
    }
    throw error_at(at(mark), path(),
                   fmt::format("the quote {} is not closed (the rest of the file would be the "
                               "value) add {}",
                               quote, quote));
  }

  void take_key(const std::string& key, const Place& where) {
    Level& level = stack_.back();
    if (key.empty())
      throw error_at(where, path(), "empty key (every key needs a name) write 'name: value'");
    if (const Tree first = level.node->find(key)) {
      throw error_at(where, path(),
                     fmt::format("key '{}' is given twice (first at {}) remove one of them", key,
                                 first->key_where.where().text()));
    }
    level.has_key = true;
    level.key = key;
    level.key_where = where;
  }

  void add(const Tree& node) {
    if (stack_.empty()) {
      root_ = node;
      return;
    }
    Level& level = stack_.back();
    if (level.node->kind == Kind::list) {
      level.node->items.push_back(node);
      return;
    }
    if (!level.has_key)
      throw error_at(node->where, path(),
                     fmt::format("{} stands in place of a key (a bracket that is not closed?) "
                                 "close it, or write 'name: value'",
                                 node->kind == Kind::null ? "nothing" : yaml::name(node->kind)));
    node->key_where = level.key_where;
    level.node->append(level.key, node);
    level.has_key = false;
  }

  void open(Kind kind, const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor) {
    refuse_anchor(mark, anchor);
    refuse_tag(mark, tag);
    const Tree node = make(kind, mark);
    if (stack_.size() >= kMaxDepth)
      throw error_at(node->where, "",
                     fmt::format("lists and maps are nested more than {} deep (brackets that are "
                                 "never closed?)",
                                 kMaxDepth));
    add(node);
    stack_.push_back({.node = node});
  }

  const std::string& text_;
  const Source& source_;
  int documents_ = 0;
  Tree root_;
  std::vector<Level> stack_;
};

std::string_view hint(std::string_view message) {
  if (message == YAML::ErrorMsg::MAP_VALUE || message == YAML::ErrorMsg::MAP_KEY)
    return " (a ': ' inside a value, or wrong indentation) quote the value or align the keys";
  if (message == YAML::ErrorMsg::END_OF_SEQ_FLOW) return " (a '[' is not closed) add ']'";
  if (message == YAML::ErrorMsg::END_OF_MAP_FLOW) return " (a '{' is not closed) add '}'";
  if (message == YAML::ErrorMsg::END_OF_MAP || message == YAML::ErrorMsg::END_OF_SEQ)
    return " (wrong indentation here or just above) align the keys";
  if (message == YAML::ErrorMsg::UNKNOWN_TOKEN)
    return " (a value cannot start with %, @ or `) put it in quotes";
  if (message == YAML::ErrorMsg::UNKNOWN_ANCHOR)
    return " (a value cannot start with *, and aliases are not supported) put it in quotes";
  return "";
}

}  // namespace

Tree parse(const std::string& text, const Source& source) {
  std::istringstream in(text);
  TreeBuilder builder(text, source);
  try {
    YAML::Parser parser(in);
    while (parser.HandleNextDocument(builder)) {
    }
  } catch (const YAML::Exception& e) {
    const Place where =
        e.mark.is_null() ? source.at(1, 1) : source.at(e.mark.line + 1, e.mark.column + 1);
    throw error_at(where, "", fmt::format("YAML syntax: {}{}", e.msg, hint(e.msg)));
  }
  const Tree root = builder.root();
  if (!root || root->kind == Kind::null)
    throw error_at(source.at(1, 1), "", "is empty (no value is given, at most comments)");
  return root;
}

}  // namespace flowslide::yaml
