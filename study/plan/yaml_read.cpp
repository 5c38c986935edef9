#include "study/plan/yaml_read.hpp"

#include "core/units.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>

#include <fmt/format.h>

namespace flowslide::study {
namespace {

/// Plain where YAML cannot take it for anything else.
std::string quoted(const std::string& text) {
  const bool plain = !text.empty() && text.front() != ' ' && text.back() != ' ' &&
                     text.front() != '-' &&
                     std::all_of(text.begin(), text.end(), [](unsigned char c) {
                       return std::isalnum(c) || c == '_' || c == '.' || c == '+' || c == '-' ||
                              c == '/' || c == ' ' || c == '%';
                     });
  const bool negative = parse_amount(text).has_value();
  if ((plain || negative) && text != "null") return text;
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') result += '\\';
    if (c == '\n') {
      result += "\\n";
      continue;
    }
    result += c;
  }
  return result + "\"";
}

std::string text_of(const YamlNode& node) {
  return node.kind() == YamlNode::Kind::scalar ? node.scalar() : flow_text(node);
}

}  // namespace

void allow_keys(const YamlNode& map, const std::vector<std::string>& known) {
  for (const auto& [key, value] : map.entries()) {
    if (std::find(known.begin(), known.end(), key) != known.end()) continue;
    const auto near = nearest(key, known);
    throw value.error(fmt::format("unknown key '{}' (it would have no effect). {}", key,
                                  near ? fmt::format("Did you mean '{}'?", *near)
                                       : fmt::format("Known: {}.", fmt::join(known, ", "))));
  }
}

YamlNode need(const YamlNode& map, std::string_view key, std::string_view why) {
  if (auto node = map.find(key)) return *node;
  throw map.error(fmt::format("has no '{}' ({}). Add it.", key, why));
}

Amount read_amount(const YamlNode& node) {
  const auto amount = parse_amount(node.scalar());
  if (!amount)
    throw node.error(
        fmt::format("'{}' is no number (a number with its unit is expected) write it as in 25 kPa",
                    node.scalar()));
  return *amount;
}

double read_number(const YamlNode& node) {
  const Amount amount = read_amount(node);
  if (!amount.unit.empty())
    throw node.error(
        fmt::format("'{}' has a unit (a plain number is expected) leave it out", node.scalar()));
  return amount.value;
}

std::size_t read_count(const YamlNode& node, std::size_t least, std::size_t most) {
  const std::string& text = node.scalar();
  std::size_t count = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), count);
  if (error != std::errc() || end != text.data() + text.size() || count < least || count > most)
    throw node.error(
        fmt::format("'{}' is no whole number from {} to {}. Give one.", text, least, most));
  return count;
}

double read_bytes(const YamlNode& node) {
  const Amount amount = read_amount(node);
  const double factor = amount.unit == "MB"   ? 1e6
                        : amount.unit == "GB" ? 1e9
                        : amount.unit == "TB" ? 1e12
                                              : kUnset;
  if (!(amount.value * factor > 0.0))
    throw node.error(
        fmt::format("'{}' is no size. Write it as in 2 GB (MB, GB, TB).", node.scalar()));
  return amount.value * factor;
}

double read_time(const YamlNode& node) {
  double seconds = kUnset;
  try {
    seconds = parse_quantity(node.scalar(), Dim::time);
  } catch (const InputError& e) {
    throw node.error(e.what());
  }
  if (!(seconds > 0.0)) throw node.error("is no time. Give one above 0.");
  return seconds;
}

std::vector<std::string> read_texts(const YamlNode& node) {
  if (node.kind() != YamlNode::Kind::list) return {text_of(node)};
  std::vector<std::string> texts;
  for (std::size_t i = 0; i < node.size(); ++i) texts.push_back(text_of(node.item(i)));
  if (texts.empty()) throw node.error("is empty (there is nothing to take). Give a value.");
  return texts;
}

bool is_path(std::string_view setting) {
  constexpr std::string_view kBegin = "stages.";
  return setting.starts_with(kBegin) && setting.size() > kBegin.size() &&
         setting.find('=') == std::string_view::npos;
}

void expect_path(const YamlNode& place, const std::string& path) {
  if (!is_path(path))
    throw place.error(fmt::format(
        "'{}' is no path of a setting (a path begins with the stages of the workflow). Write it "
        "as in stages.map.with.c_soft_ratio.",
        path));
}

std::vector<std::string> read_settings_paths(const YamlNode& node) {
  std::vector<std::string> paths = read_texts(node);
  for (const std::string& path : paths) expect_path(node, path);
  return paths;
}

std::string flow_text(const YamlNode& node) {
  switch (node.kind()) {
    case YamlNode::Kind::null:
      return "null";
    case YamlNode::Kind::scalar:
      return quoted(node.scalar());
    case YamlNode::Kind::list: {
      std::vector<std::string> items;
      for (std::size_t i = 0; i < node.size(); ++i) items.push_back(flow_text(node.item(i)));
      return fmt::format("[{}]", fmt::join(items, ", "));
    }
    case YamlNode::Kind::map: {
      std::vector<std::string> items;
      for (const auto& [key, value] : node.entries())
        items.push_back(fmt::format("{}: {}", quoted(key), flow_text(value)));
      return fmt::format("{{{}}}", fmt::join(items, ", "));
    }
  }
  return "";
}

}  // namespace flowslide::study
