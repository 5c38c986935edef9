#include "config/manual.hpp"

#include "config/range_text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace flowslide {
namespace {

constexpr std::string_view kRequired = "required";
constexpr std::string_view kOptional = "optional";

std::string kind_of(Dim dim) {
  if (dim == Dim::none) return "number";
  return fmt::format("{} ({})", name(dim), fmt::join(known_units(dim), ", "));
}

std::string code(std::string_view text) { return fmt::format("`{}`", text); }

std::string default_of(double value, Dim dim) {
  return is_set(value) ? code(shown_value(value, dim)) : std::string(kRequired);
}

template <class Range>
std::string default_list(const Range& texts) {
  return code(fmt::format("[{}]", fmt::join(texts, ", ")));
}

std::vector<std::string> texts_of(std::span<const double> values, Dim dim) {
  std::vector<std::string> texts;
  for (const double value : values) texts.push_back(shown_value(value, dim));
  return texts;
}

class ManualPage final : public FieldVisitor {
 public:
  [[nodiscard]] const std::string& rows_text() const { return rows_; }

  void quantity(std::string_view key, double& value, Dim dim, Range range,
                std::string_view doc) override {
    row(key, kind_of(dim), default_of(value, dim), shown_range(range, dim), doc);
  }
  void quantity(std::string_view key, std::optional<double>& value, Dim dim, Range range,
                std::string_view doc) override {
    row(key, kind_of(dim), value ? default_of(*value, dim) : std::string(kOptional),
        shown_range(range, dim), doc);
  }
  void integer(std::string_view key, int& value, Range range, std::string_view doc) override {
    row(key, "whole number",
        range.contains(value) ? code(std::to_string(value)) : std::string(kRequired),
        range_text(range, "", 1.0), doc);
  }
  void flag(std::string_view key, bool& value, std::string_view doc) override {
    row(key, "true or false", code(value ? "true" : "false"), "", doc);
  }
  void text(std::string_view key, std::string& value, std::string_view doc) override {
    row(key, "text", value.empty() ? std::string(kRequired) : code(value), "", doc);
  }
  void text(std::string_view key, std::optional<std::string>& value,
            std::string_view doc) override {
    row(key, "text", value ? code(*value) : std::string(kOptional), "", doc);
  }
  void file(std::string_view key, InputFile& value, std::string_view doc) override {
    row(key, "file", value.path.empty() ? std::string(kRequired) : code(value.path.string()), "",
        doc);
  }
  void file(std::string_view key, std::optional<InputFile>& value, std::string_view doc) override {
    row(key, "file", value ? code(value->path.string()) : std::string(kOptional), "", doc);
  }
  void tuple(std::string_view key, std::span<double> values, Dim dim,
             std::string_view doc) override {
    bool set = true;
    for (const double value : values) set = set && is_set(value);
    row(key, fmt::format("list of {}: {}", values.size(), kind_of(dim)),
        set ? default_list(texts_of(values, dim)) : std::string(kRequired), "", doc);
  }
  void numbers(std::string_view key, std::vector<double>& values, Dim dim,
               std::string_view doc) override {
    row(key, fmt::format("list: {}", kind_of(dim)), default_list(texts_of(values, dim)), "", doc);
  }
  void integers(std::string_view key, std::vector<int>& values, std::string_view doc) override {
    row(key, "list: whole number", default_list(values), "", doc);
  }
  void texts(std::string_view key, std::vector<std::string>& values,
             std::string_view doc) override {
    row(key, "list: text", default_list(values), "", doc);
  }
  void rows(std::string_view key, std::vector<std::vector<double>>& values,
            std::span<const Column> columns, std::string_view doc) override {
    std::vector<std::string> kinds;
    for (const Column& column : columns)
      kinds.push_back(fmt::format("{}: {}", column.name, kind_of(column.dim)));
    std::vector<std::string> lines;
    for (const auto& values_of_row : values) {
      std::vector<std::string> cells;
      for (std::size_t i = 0; i < columns.size(); ++i)
        cells.push_back(shown_value(values_of_row[i], columns[i].dim));
      lines.push_back(fmt::format("[{}]", fmt::join(cells, ", ")));
    }
    row(key, fmt::format("list of rows [{}]", fmt::join(kinds, "; ")), default_list(lines), "",
        doc);
  }

 protected:
  void choice_index(std::string_view key, int& index, std::span<const std::string_view> names,
                    std::string_view doc) override {
    std::vector<std::string> choices;
    for (const std::string_view choice : names) choices.push_back(code(choice));
    row(key, "choice", code(names[static_cast<std::size_t>(index)]),
        fmt::format("{}", fmt::join(choices, ", ")), doc);
  }
  bool begin_group(std::string_view key, Presence presence, std::string_view doc) override {
    row(key, "group", presence == Presence::absent ? kOptional : "", "", doc);
    path_.push_back(child(key));
    return true;
  }
  void end_group() override { path_.pop_back(); }
  std::size_t begin_list(std::string_view key, std::size_t, std::string_view doc) override {
    row(key, "list of groups", code("[]"), "", doc);
    path_.push_back(child(key) + "[]");
    return 1;
  }
  bool begin_item(std::size_t) override {
    path_.push_back(path_.back());
    return true;
  }
  void end_list() override { path_.pop_back(); }
  std::vector<std::string> begin_table(std::string_view key, const std::vector<std::string>&,
                                       std::string_view doc) override {
    row(key, "table of groups", code("{}"), "", doc);
    path_.push_back(child(key));
    return {"<name>"};
  }
  bool begin_entry(const std::string& entry) override {
    path_.push_back(child(entry));
    return true;
  }
  void end_table() override { path_.pop_back(); }

 private:
  [[nodiscard]] std::string child(std::string_view key) const {
    return path_.empty() ? std::string(key) : fmt::format("{}.{}", path_.back(), key);
  }

  static std::string cell(std::string_view text) {
    std::string escaped;
    for (const char c : text) {
      if (c == '|') escaped += '\\';
      escaped += c;
    }
    return escaped;
  }

  void row(std::string_view key, std::string_view kind, std::string_view preset,
           std::string_view allowed, std::string_view doc) {
    rows_ += fmt::format("| `{}` | {} | {} | {} | {} |\n", cell(child(key)), cell(kind),
                         cell(preset), cell(allowed), cell(doc));
  }

  std::vector<std::string> path_;
  std::string rows_;
};

}  // namespace

std::string detail::manual_fields(std::string_view title, std::string_view doc,
                                  const std::function<void(FieldVisitor&)>& describe) {
  ManualPage page;
  describe(page);
  return fmt::format(
      "# {}\n\n{}\n\n| Key | Kind and units | Default | Allowed | Meaning |\n"
      "|---|---|---|---|---|\n{}",
      title, doc, page.rows_text());
}

}  // namespace flowslide
