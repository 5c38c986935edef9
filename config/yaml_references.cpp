#include "config/yaml_data.hpp"

#include <algorithm>
#include <unordered_set>

#include <fmt/format.h>

namespace flowslide::yaml {
namespace {

using Kind = YamlNode::Kind;

constexpr std::size_t kMaxChain = 8;
/// Values that references may add to a document: a few of them, each of which holds the one before
/// twice, would otherwise fill the memory.
constexpr std::size_t kMaxCopied = 100'000;

bool is_reference(std::string_view text) { return text.find("${") != std::string_view::npos; }

std::size_t depth_of(const YamlNode::Data& node) {
  std::size_t depth = 0;
  for (const Path* path = node.path.get(); path; path = path->above.get()) ++depth;
  return depth;
}

/// Settles every node once: a reference when what it names has been settled.
class References {
 public:
  explicit References(const Tree& root) : root_(root) {}

  void settle(YamlNode::Data& node) {
    if (settled_.count(&node) > 0) return;
    if (node.kind == Kind::scalar && is_reference(node.scalar)) {
      resolve(node);
    } else {
      open_.insert(&node);
      for (const Tree& child : node.items) settle(*child);
      for (const auto& [key, child] : node.entries) settle(*child);
      open_.erase(&node);
    }
    settled_.insert(&node);
  }

 private:
  [[nodiscard]] static InputError fail(const YamlNode::Data& node, std::string_view text) {
    return error_at(node.where, node.path_text(), fmt::format("'{}'{}", node.scalar, text));
  }

  void resolve(YamlNode::Data& node) {
    const std::string written = node.scalar;
    if (!written.starts_with("${") || written.find('}') != written.size() - 1)
      throw fail(node,
                 " holds a reference within text (a reference is the whole value) write "
                 "'${path.to.key}' alone");
    chain_.push_back(&node);
    open_.insert(&node);
    const Tree target = find_target(node, written.substr(2, written.size() - 3));
    refuse_circle(node, *target);
    if (chain_.size() > kMaxChain)
      throw fail(node, fmt::format(" ends a chain of more than {} references (hard to follow) "
                                   "refer to the value itself",
                                   kMaxChain));
    settle(*target);
    open_.erase(&node);
    chain_.pop_back();
    copy(*target, node, written, depth_of(node), node);
    node.reference = written;
  }

  /// What is being settled waits for this reference.
  void refuse_circle(const YamlNode::Data& node, const YamlNode::Data& target) const {
    if (open_.count(&target) == 0) return;
    std::string circle;
    for (const auto* link : chain_) circle += link->path_text() + " -> ";
    const std::string end = target.path ? target.path_text() : "the file";
    throw fail(node,
               fmt::format(" refers to itself ({}{}) {}", circle, end,
                           target.kind == Kind::scalar ? "give one of them a value"
                                                       : "refer to a part that lies outside"));
  }

  Tree find_target(const YamlNode::Data& from, const std::string& target) {
    const auto keys = split_path(target);
    if (!is_path(keys)) throw fail(from, ": is not a path (keys are separated by single dots)");
    Tree node = root_;
    for (const std::string& key : keys) {
      if (node->kind == Kind::scalar && is_reference(node->scalar)) {
        refuse_circle(from, *node);
        settle(*node);
      }
      node = step(from, *node, key);
    }
    if (node->kind == Kind::null)
      throw fail(from, fmt::format(": {} is without a value (a reference takes the value that is "
                                   "written there)",
                                   node->path_text()));
    return node;
  }

  [[nodiscard]] static Tree step(const YamlNode::Data& from, const YamlNode::Data& node,
                                 const std::string& key) {
    const std::string path = node.path ? node.path_text() : "the file";
    if (node.kind == Kind::scalar) throw fail(from, ": " + no_key(path, node, key));
    Tree child = node.kind == Kind::list ? item(node, key) : node.find(key);
    if (child) return child;
    if (node.kind == Kind::list) throw fail(from, ": " + no_item(path, node, key));
    std::vector<std::string> known;
    for (const auto& [name, unused] : node.entries) known.push_back(name);
    const auto near = nearest(key, known);
    throw fail(from, fmt::format(": {} has no key '{}' (a reference needs a value that is written "
                                 "there){}",
                                 path, key, near ? fmt::format(" did you mean '{}'?", *near) : ""));
  }

  /// The value of `source` for `node`, which keeps its own place and path; what lies below is told
  /// from where it is written.
  void copy(const YamlNode::Data& source, YamlNode::Data& node, const std::string& written,
            std::size_t depth, const YamlNode::Data& reference) {
    const auto refuse = [&](const char* problem) {
      return error_at(
          reference.where, reference.path_text(),
          fmt::format("'{}' {} write the value in place of the reference", written, problem));
    };
    if (++copied_ > kMaxCopied)
      throw refuse("makes the file too large (of references in references)");
    if (depth > static_cast<std::size_t>(kMaxDepth))
      throw refuse("nests too deep (of references in references)");
    const auto child = [&](const Tree& from, const std::string& key) {
      auto to = std::make_shared<YamlNode::Data>();
      to->where = from->where;
      to->key_where = from->key_where;
      to->path = std::make_shared<const Path>(Path{node.path, key});
      to->folder = node.folder;
      to->reference = fmt::format("${{{}}}", from->path_text());
      copy(*from, *to, written, depth + 1, reference);
      settled_.insert(to.get());
      return to;
    };
    node.kind = source.kind;
    node.scalar = source.scalar;
    for (std::size_t i = 0; i < source.items.size(); ++i)
      node.items.push_back(child(source.items[i], std::to_string(i)));
    for (const auto& [key, value] : source.entries) node.append(key, child(value, key));
  }

  Tree root_;
  std::unordered_set<const YamlNode::Data*> settled_, open_;
  std::vector<const YamlNode::Data*> chain_;  ///< references that wait for each other
  std::size_t copied_ = 0;
};

}  // namespace

void resolve_references(const Tree& root) { References(root).settle(*root); }

}  // namespace flowslide::yaml
