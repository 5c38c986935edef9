#include "config/manual.hpp"
#include "config/range_text.hpp"

#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

namespace flowslide {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::string_view kNumber = R"([+-]?([0-9]+\.?[0-9]*|\.[0-9]+)([eE][+-]?[0-9]+)?)";
constexpr std::string_view kReference = R"(\$\{[^${}]+\})";

Json text_pattern(std::string_view pattern) {
  return {{"type", "string"}, {"pattern", fmt::format("^({}|{})$", pattern, kReference)}};
}

Json bounded(std::string_view type, const Range& range) {
  Json schema = {{"type", type}};
  if (std::isfinite(range.min)) schema["minimum"] = range.min;
  if (std::isfinite(range.max)) schema["maximum"] = range.max;
  if (std::isfinite(range.above)) schema["exclusiveMinimum"] = range.above;
  if (std::isfinite(range.below)) schema["exclusiveMaximum"] = range.below;
  return schema;
}

Json any_of(Json a, Json b) { return {{"anyOf", Json::array({std::move(a), std::move(b)})}}; }

Json or_reference(Json schema) {
  return any_of(std::move(schema),
                {{"type", "string"}, {"pattern", fmt::format("^{}$", kReference)}});
}

Json quantity_schema(Dim dim, const Range& range) {
  if (dim == Dim::none)
    return any_of(bounded("number", range), text_pattern(fmt::format("{} *%", kNumber)));
  return text_pattern(fmt::format("{} *({})", kNumber, fmt::join(known_units(dim), "|")));
}

Json text_schema() { return {{"type", "string"}, {"minLength", 1}}; }

/// Lists and maps may be references too. What is said of items and properties, and what of text, do
/// not disturb each other.
Json list_or_map(std::string_view type) {
  return {{"type", {type, "string"}}, {"pattern", fmt::format("^{}$", kReference)}};
}

Json array_of(Json item) {
  Json schema = list_or_map("array");
  schema["items"] = std::move(item);
  return schema;
}

class JsonSchema final : public FieldVisitor {
 public:
  explicit JsonSchema(std::string_view doc) { open(doc); }

  [[nodiscard]] Json take() {
    Json schema = close();
    schema["type"] = "object";
    schema.erase("pattern");
    return schema;
  }

  void quantity(std::string_view key, double& value, Dim dim, Range range,
                std::string_view doc) override {
    add(key, quantity_schema(dim, range), doc, !is_set(value), shown_range(range, dim));
    if (is_set(value)) preset(key, value, dim);
  }
  void quantity(std::string_view key, std::optional<double>& value, Dim dim, Range range,
                std::string_view doc) override {
    add(key, quantity_schema(dim, range), doc, false, shown_range(range, dim));
    if (value) preset(key, *value, dim);
  }
  void integer(std::string_view key, int& value, Range range, std::string_view doc) override {
    add(key, or_reference(bounded("integer", range)), doc, !range.contains(value));
    if (range.contains(value)) property(key)["default"] = value;
  }
  void flag(std::string_view key, bool& value, std::string_view doc) override {
    add(key, or_reference({{"type", "boolean"}}), doc);
    property(key)["default"] = value;
  }
  void text(std::string_view key, std::string& value, std::string_view doc) override {
    add(key, text_schema(), doc, value.empty());
    if (!value.empty()) property(key)["default"] = value;
  }
  void text(std::string_view key, std::optional<std::string>& value,
            std::string_view doc) override {
    add(key, text_schema(), doc);
    if (value) property(key)["default"] = *value;
  }
  void file(std::string_view key, InputFile& value, std::string_view doc) override {
    add(key, text_schema(), doc, value.path.empty());
    if (!value.path.empty()) property(key)["default"] = value.path.string();
  }
  void file(std::string_view key, std::optional<InputFile>&, std::string_view doc) override {
    add(key, text_schema(), doc);
  }
  void tuple(std::string_view key, std::span<double> values, Dim dim,
             std::string_view doc) override {
    bool unset = false;
    for (const double value : values) unset = unset || !is_set(value);
    Json schema = array_of(quantity_schema(dim, {}));
    schema["minItems"] = values.size();
    schema["maxItems"] = values.size();
    add(key, std::move(schema), doc, unset);
  }
  void numbers(std::string_view key, std::vector<double>&, Dim dim, std::string_view doc) override {
    add(key, array_of(quantity_schema(dim, {})), doc);
  }
  void integers(std::string_view key, std::vector<int>&, std::string_view doc) override {
    add(key, array_of(or_reference({{"type", "integer"}})), doc);
  }
  void texts(std::string_view key, std::vector<std::string>&, std::string_view doc) override {
    add(key, array_of(text_schema()), doc);
  }
  void rows(std::string_view key, std::vector<std::vector<double>>&,
            std::span<const Column> columns, std::string_view doc) override {
    Json cells = Json::array();
    for (const Column& column : columns) {
      Json cell = quantity_schema(column.dim, {});
      cell["description"] = column.name;
      cells.push_back(std::move(cell));
    }
    Json row = list_or_map("array");
    row["prefixItems"] = std::move(cells);
    row["minItems"] = columns.size();
    row["maxItems"] = columns.size();
    add(key, array_of(std::move(row)), doc);
  }

 protected:
  void choice_index(std::string_view key, int& index, std::span<const std::string_view> names,
                    std::string_view doc) override {
    Json choices = Json::array();
    for (const std::string_view choice : names) choices.push_back(choice);
    add(key, or_reference({{"enum", std::move(choices)}}), doc);
    property(key)["default"] = names[static_cast<std::size_t>(index)];
  }
  bool begin_group(std::string_view key, Presence presence, std::string_view doc) override {
    open(doc);
    levels_.back().key = key;
    levels_.back().may_be_left_out = presence != Presence::required_or_default;
    return true;
  }
  void end_group() override {
    const bool is_group = levels_.back().kind == Level::Kind::group;
    const std::string key = levels_.back().key;
    const bool may_be_left_out = levels_.back().may_be_left_out;
    Json schema = close();
    if (is_group) {
      const bool required = !may_be_left_out && schema.contains("required");
      const std::string doc = schema["description"];
      add(key, std::move(schema), doc, required);
    } else {
      levels_.back().entry = std::move(schema);
    }
  }
  std::size_t begin_list(std::string_view key, std::size_t, std::string_view doc) override {
    open(doc);
    levels_.back().key = key;
    return 1;
  }
  bool begin_item(std::size_t) override {
    open("");
    levels_.back().kind = Level::Kind::entry;
    return true;
  }
  void end_list() override {
    const Level list = pop();
    add(list.key, array_of(list.entry), list.doc);
  }
  std::vector<std::string> begin_table(std::string_view key, const std::vector<std::string>&,
                                       std::string_view doc) override {
    open(doc);
    levels_.back().key = key;
    return {"<name>"};
  }
  bool begin_entry(const std::string&) override { return begin_item(0); }
  void end_table() override {
    const Level table = pop();
    Json schema = list_or_map("object");
    schema["additionalProperties"] = table.entry;
    add(table.key, std::move(schema), table.doc);
  }

 private:
  struct Level {
    enum class Kind { group, entry };
    Kind kind = Kind::group;
    std::string key = {};
    std::string doc = {};
    bool may_be_left_out = false;
    Json properties = Json::object();
    Json required = Json::array();
    Json entry = Json::object();  ///< of a list or table: the schema of one entry
  };

  void open(std::string_view doc) { levels_.push_back({.doc = std::string(doc)}); }

  Level pop() {
    Level level = std::move(levels_.back());
    levels_.pop_back();
    return level;
  }

  Json close() {
    Level level = pop();
    Json schema = list_or_map("object");
    if (!level.doc.empty()) schema["description"] = level.doc;
    schema["properties"] = std::move(level.properties);
    if (!level.required.empty()) schema["required"] = std::move(level.required);
    schema["additionalProperties"] = false;
    return schema;
  }

  Json& property(std::string_view key) { return levels_.back().properties[std::string(key)]; }

  void add(std::string_view key, Json schema, std::string_view doc, bool required = false,
           const std::string& allowed = {}) {
    schema["description"] =
        allowed.empty() ? std::string(doc) : fmt::format("{} (allowed: {})", doc, allowed);
    property(key) = std::move(schema);
    if (required) levels_.back().required.push_back(key);
  }

  void preset(std::string_view key, double value, Dim dim) {
    if (dim == Dim::none)
      property(key)["default"] = value;
    else
      property(key)["default"] = shown_value(value, dim);
  }

  std::vector<Level> levels_;
};

}  // namespace

std::string detail::json_schema_fields(std::string_view doc,
                                       const std::function<void(FieldVisitor&)>& describe) {
  JsonSchema schema(doc);
  describe(schema);
  return schema.take().dump(2);
}

}  // namespace flowslide
