#include "core/files.hpp"
#include "core/odd_characters.hpp"
#include "study/plan/read_parts.hpp"
#include "study/plan/yaml_read.hpp"

#include <algorithm>
#include <sstream>

#include <fmt/format.h>

namespace flowslide::study {
namespace {

std::string trimmed(std::string text) {
  while (!text.empty() && (text.back() == ' ' || text.back() == '\r')) text.pop_back();
  text.erase(0, std::min(text.find_first_not_of(' '), text.size()));
  return text;
}

/// A line of a table that is no comment.
struct Line {
  std::size_t number = 0;  ///< in the file, from 1
  std::vector<std::string> cells;
};

/// Without the quotes that some programs put around every cell.
std::string unquoted(std::string cell) {
  if (cell.size() < 2 || cell.front() != '"' || cell.back() != '"') return cell;
  const std::string inside = cell.substr(1, cell.size() - 2);
  return inside.find('"') == std::string::npos ? trimmed(inside) : cell;
}

/// What stands after a last comma is a cell, if an empty one.
std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells;
  for (std::size_t begin = 0;;) {
    const std::size_t end = line.find(',', begin);
    cells.push_back(unquoted(trimmed(line.substr(begin, end - begin))));
    if (end == std::string::npos) return cells;
    begin = end + 1;
  }
}

/// `header` is the first line.
void check_line(const YamlNode& node, const std::string& file, const Line& header, const Line& line,
                const std::string& text) {
  const auto refuse = [&](const std::string& problem) {
    return node.error(fmt::format("{}:{}: {}", file, line.number, problem));
  };
  const std::size_t expected = header.cells.size(), found = line.cells.size();
  if (found != expected) {
    std::string odd = text.find(';') != std::string::npos
                          ? "has semicolons (commas part the cells) write ',' between cells "
                            "and '.' in numbers"
                          : odd_characters(text);
    // Where commas part the cells, one between digits is a decimal comma in quotes only.
    if (odd.starts_with("has a decimal comma") && text.find('"') == std::string::npos) odd.clear();
    throw refuse(
        fmt::format("has {} cell{}, and the header {} ({}). {}.", found, found == 1 ? "" : "s",
                    expected, fmt::join(header.cells, ", "),
                    odd.empty() ? "Give each column one, with a comma between them" : "It " + odd));
  }
  if (&line == &header) return;
  // The first cell is a name, and names may have what numbers have not.
  for (std::size_t i = 1; i < found; ++i)
    if (const std::string inside = odd_characters(line.cells[i]); !inside.empty())
      throw refuse(fmt::format("column '{}': '{}' {}.", header.cells[i], line.cells[i], inside));
}

/// Comma-separated, one header line; lines that begin with '#' are comments.
std::vector<Line> read_csv(const YamlNode& node) {
  const std::filesystem::path path = node.folder() / node.scalar();
  std::string text;
  try {
    text = flowslide::read_file(path, 1u << 20);
  } catch (const FileError& e) {
    throw FileError(node.error(e.what()).what());
  }
  if (text.find('\0') != std::string::npos)
    throw node.error(
        fmt::format("{}: holds NUL bytes (a binary file or UTF-16 text) save it as CSV in UTF-8.",
                    path.string()));
  if (text.starts_with("\xEF\xBB\xBF")) text.erase(0, 3);
  // Of old line ends each is one; of the usual two bytes one remains for getline.
  for (std::size_t i = 0; i < text.size(); ++i)
    if (text[i] == '\r') text[i] = i + 1 < text.size() && text[i + 1] == '\n' ? ' ' : '\n';
  std::vector<Line> lines;
  std::istringstream in(text);
  std::size_t number = 0;
  for (std::string line; std::getline(in, line);) {
    ++number;
    line = trimmed(line);
    if (line.empty() || line[0] == '#') continue;
    lines.push_back({number, cells_of(line)});
    check_line(node, path.string(), lines.front(), lines.back(), line);
  }
  if (lines.size() < 2) throw node.error("holds no row (a header and a row are expected).");
  return lines;
}

}  // namespace

void read_table(Variable& variable, const YamlNode& node) {
  allow_keys(node, {"table", "columns", "rows"});
  const YamlNode file = *node.find("table");
  const std::vector<Line> lines = read_csv(file);
  const std::vector<std::string>& header = lines.front().cells;
  const std::string name_of_file = (file.folder() / file.scalar()).string();
  std::vector<std::string> wanted;
  if (const auto rows = node.find("rows")) wanted = read_texts(*rows);
  for (std::size_t i = 1; i < lines.size(); ++i)
    if (wanted.empty() ||
        std::find(wanted.begin(), wanted.end(), lines[i].cells[0]) != wanted.end())
      variable.choices.push_back({lines[i].cells[0], {}, {}});
  for (const std::string& name : wanted)
    if (std::none_of(variable.choices.begin(), variable.choices.end(),
                     [&](const Choice& c) { return c.label == name; }))
      throw node.find("rows")->error(
          fmt::format("'{}' is no row of {}. Take its first column.", name, file.scalar()));
  const YamlNode columns = need(node, "columns", "which column gives which setting?");
  for (const auto& [column, paths] : columns.entries()) {
    const auto at = std::find(header.begin(), header.end(), column);
    if (at == header.end())
      throw paths.error(fmt::format("{} has no column '{}'. It has: {}.", file.scalar(), column,
                                    fmt::join(header, ", ")));
    if (std::count(header.begin(), header.end(), column) > 1)
      throw paths.error(fmt::format("{} has several columns '{}'. Give each a name of its own.",
                                    file.scalar(), column));
    const auto cell = static_cast<std::size_t>(at - header.begin());
    for (std::size_t i = 1; i < lines.size(); ++i)
      if (const std::string& text = lines[i].cells[cell];
          text.empty() || text == "~" || text == "null")
        throw paths.error(
            fmt::format("{}:{}: row '{}', column '{}' is empty (the setting would fall back to its "
                        "default). Write a value.",
                        name_of_file, lines[i].number, lines[i].cells[0], column));
    for (const std::string& path : read_settings_paths(paths)) {
      variable.settings.push_back(path);
      std::size_t choice = 0;
      for (std::size_t i = 1; i < lines.size(); ++i)
        if (choice < variable.choices.size() &&
            variable.choices[choice].label == lines[i].cells[0]) {
          Choice& row = variable.choices[choice++];
          row.set.emplace_back(path, lines[i].cells[cell]);
          row.places.push_back(fmt::format("{}: {}:{}: column '{}'", variable.place, name_of_file,
                                           lines[i].number, column));
        }
    }
  }
  if (variable.settings.empty())
    throw columns.error("is empty (no column would set anything). Name a setting.");
}

}  // namespace flowslide::study
