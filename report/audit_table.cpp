#include "report/audit_table.hpp"

#include "core/check.hpp"
#include "core/files.hpp"

#include <algorithm>
#include <vector>

#include <nlohmann/json.hpp>

namespace flowslide {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::uint64_t kLargestAudit = 16u << 20u;  ///< bytes; an audit has a few thousand

std::string value_text(const Json& value) {
  if (value.is_number_float()) return fmt::format("{:.4g}", value.get<double>());
  if (value.is_null()) return "-";
  if (value.is_boolean()) return value.get<bool>() ? "yes" : "no";
  if (value.is_string()) return cell(value.get<std::string>());
  if (value.is_array()) {
    std::string out;
    for (const Json& item : value) out += (out.empty() ? "" : ", ") + value_text(item);
    return out.empty() ? "none" : out;
  }
  return cell(value.dump());
}

std::string heading(const std::string& key) {
  std::string text = key;
  std::replace(text.begin(), text.end(), '_', ' ');
  return cell(text);
}

bool is_table(const Json& value) {
  return value.is_array() && !value.empty() &&
         std::all_of(value.begin(), value.end(), [](const Json& row) { return row.is_object(); });
}

std::string table_of_objects(const Json& rows) {
  std::vector<std::string> keys;
  for (const Json& row : rows)
    for (const auto& [key, unused] : row.items())
      if (std::find(keys.begin(), keys.end(), key) == keys.end()) keys.push_back(key);
  std::string out = "|";
  for (const std::string& key : keys) out += " " + heading(key) + " |";
  out += "\n|" + [&] {
    std::string rule;
    for (std::size_t k = 0; k < keys.size(); ++k) rule += "---|";
    return rule;
  }() + "\n";
  for (const Json& row : rows) {
    out += "|";
    for (const std::string& key : keys)
      out += " " + (row.contains(key) ? value_text(row[key]) : "") + " |";
    out += "\n";
  }
  return out + "\n";
}

/// Scalars of nested objects as "outer, inner" rows; tables are collected for later.
void collect(const std::string& prefix, const Json& object, std::string& rows,
             std::string& tables) {
  for (const auto& [key, value] : object.items()) {
    const std::string name = prefix.empty() ? heading(key) : prefix + ", " + heading(key);
    if (is_table(value))
      tables += fmt::format("**{}**\n\n{}", name, table_of_objects(value));
    else if (value.is_object())
      collect(name, value, rows, tables);
    else
      rows += fmt::format("| {} | {} |\n", name, value_text(value));
  }
}

}  // namespace

std::string cell(std::string_view text) {
  std::string out;
  for (const char c : text) {
    if (c == '|') out += '\\';
    out += c == '\n' || c == '\r' ? ' ' : c;
  }
  return out;
}

std::string audit_tables(const std::filesystem::path& audit) {
  // Tables are made by recursion, which an audit from elsewhere must not drive too deep.
  constexpr int kDeepest = 32;
  const auto bounded = [&](int depth, Json::parse_event_t, const Json&) {
    validate(depth <= kDeepest,
             "{}: is nested more than {} deep (no audit is) run the transfer again", audit.string(),
             kDeepest);
    return true;
  };
  const Json json = Json::parse(read_file(audit, kLargestAudit), bounded, false);
  validate(json.is_object(), "{}: is not a JSON object (an audit is one) run the transfer again",
           audit.string());
  std::string rows, tables;
  collect("", json, rows, tables);
  if (!rows.empty()) tables += "| quantity | value |\n|---|---|\n" + rows + "\n";
  return tables;
}

}  // namespace flowslide
