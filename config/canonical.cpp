#include "config/canonical.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace flowslide {
namespace {

/// Text between quotes, so that no value can look like another line or another value.
std::string in_quotes(std::string_view text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') {
      out += '\\';
      out += c;
    } else if (static_cast<unsigned char>(c) < 0x20) {
      out += fmt::format("\\x{:02x}", static_cast<unsigned char>(c));
    } else {
      out += c;
    }
  }
  return out + '"';
}

std::string number(double value, Dim dim) {
  return to_text(value == 0.0 ? 0.0 : value, dim);  // one text for 0 and -0
}

std::string numbers_text(std::span<const double> values, Dim dim) {
  std::vector<std::string> texts;
  for (const double value : values) texts.push_back(number(value, dim));
  return fmt::format("[{}]", fmt::join(texts, ", "));
}

class CanonicalText final : public FieldVisitor {
 public:
  [[nodiscard]] CanonicalSettings take() { return {std::move(lines_), std::move(files_)}; }

  void quantity(std::string_view key, double& value, Dim dim, Range, std::string_view) override {
    line(key, number(value, dim));
  }
  void quantity(std::string_view key, std::optional<double>& value, Dim dim, Range,
                std::string_view) override {
    if (value) line(key, number(*value, dim));
  }
  void integer(std::string_view key, int& value, Range, std::string_view) override {
    line(key, std::to_string(value));
  }
  void flag(std::string_view key, bool& value, std::string_view) override {
    line(key, value ? "true" : "false");
  }
  void text(std::string_view key, std::string& value, std::string_view) override {
    line(key, in_quotes(value));
  }
  void text(std::string_view key, std::optional<std::string>& value, std::string_view) override {
    if (value) line(key, in_quotes(*value));
  }
  void file(std::string_view key, InputFile& value, std::string_view) override {
    hash_line(key, value);
  }
  void file(std::string_view key, std::optional<InputFile>& value, std::string_view) override {
    if (value) hash_line(key, *value);
  }
  void tuple(std::string_view key, std::span<double> values, Dim dim, std::string_view) override {
    line(key, numbers_text(values, dim));
  }
  void numbers(std::string_view key, std::vector<double>& values, Dim dim,
               std::string_view) override {
    line(key, numbers_text(values, dim));
  }
  void integers(std::string_view key, std::vector<int>& values, std::string_view) override {
    line(key, fmt::format("[{}]", fmt::join(values, ", ")));
  }
  void texts(std::string_view key, std::vector<std::string>& values, std::string_view) override {
    line(key, list_of(values));
  }
  void rows(std::string_view key, std::vector<std::vector<double>>& values,
            std::span<const Column> columns, std::string_view) override {
    std::vector<std::string> lines;
    for (const auto& row : values) {
      std::vector<std::string> cells;
      for (std::size_t i = 0; i < row.size(); ++i) cells.push_back(number(row[i], columns[i].dim));
      lines.push_back(fmt::format("[{}]", fmt::join(cells, ", ")));
    }
    line(key, fmt::format("[{}]", fmt::join(lines, ", ")));
  }

 protected:
  void choice_index(std::string_view key, int& index, std::span<const std::string_view> names,
                    std::string_view) override {
    line(key, std::string(names[static_cast<std::size_t>(index)]));
  }
  bool begin_group(std::string_view key, Presence presence, std::string_view) override {
    if (presence == Presence::present) line(key, "given");
    path_.emplace_back(key);
    return presence != Presence::absent;
  }
  void end_group() override { path_.pop_back(); }
  std::size_t begin_list(std::string_view key, std::size_t size, std::string_view) override {
    line(key, fmt::format("list of {}", size));
    path_.emplace_back(key);
    return size;
  }
  bool begin_item(std::size_t index) override {
    path_.push_back(std::to_string(index));
    return true;
  }
  void end_list() override { path_.pop_back(); }
  std::vector<std::string> begin_table(std::string_view key, const std::vector<std::string>& names,
                                       std::string_view) override {
    line(key, "table of " + list_of(names));
    path_.emplace_back(key);
    return names;
  }
  bool begin_entry(const std::string& name) override {
    path_.push_back(in_quotes(name));
    return true;
  }
  void end_table() override { path_.pop_back(); }

 private:
  static std::string list_of(const std::vector<std::string>& texts) {
    std::vector<std::string> parts;
    std::transform(texts.begin(), texts.end(), std::back_inserter(parts), in_quotes);
    return fmt::format("[{}]", fmt::join(parts, ", "));
  }

  [[nodiscard]] std::string path_of(std::string_view key) const {
    return path_.empty() ? std::string(key) : fmt::format("{}.{}", fmt::join(path_, "."), key);
  }
  void line(std::string_view key, const std::string& value) {
    lines_ += fmt::format("{} = {}\n", path_of(key), value);
  }
  void hash_line(std::string_view key, const InputFile& file) {
    try {
      files_.push_back(hash_file(file.path));
      line(key, "sha256:" + files_.back().sha256);
    } catch (const FileError& e) {
      throw FileError(fmt::format("{}: {}", path_of(key), e.what()));
    }
  }

  std::vector<std::string> path_;
  std::string lines_;
  std::vector<HashedFile> files_;
};

}  // namespace

CanonicalSettings detail::canonical_settings(const std::function<void(FieldVisitor&)>& describe) {
  CanonicalText text;
  describe(text);
  return text.take();
}

std::string detail::canonical_fields(const std::function<void(FieldVisitor&)>& describe) {
  return canonical_settings(describe).text;
}

}  // namespace flowslide
