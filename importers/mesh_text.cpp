#include "importers/mesh_text.hpp"

#include "core/check.hpp"
#include "importers/mesh_faults.hpp"
#include "importers/recorder_text.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <set>
#include <unordered_map>

#include <fmt/format.h>

namespace flowslide {
namespace {

struct Table {
  std::string file;
  std::vector<std::vector<double>> rows;
  std::vector<std::int64_t> lines;
  std::vector<std::string> notes;
};

Table read_table(const std::filesystem::path& path, const std::vector<std::string>& columns,
                 std::string_view setting) {
  LineReader reader(path);
  NumberLine numbers;
  Table table;
  table.file = reader.name();
  std::string_view line;
  std::vector<double> values;
  while (reader.next(line)) {
    if (line.find_first_not_of(" \t\v\f") == std::string_view::npos) continue;
    if (table.rows.empty() && NumberLine::is_header(line)) {
      table.notes.push_back(
          fmt::format("{}:{}: header line skipped", table.file, reader.line_number()));
      continue;
    }
    const std::string problem = numbers.parse(line, values);
    validate(problem.empty(), "{}:{}: {}", table.file, reader.line_number(), problem);
    validate(values.size() == columns.size(),
             "{}:{}: {} columns, but `{}` names {}: [{}]. Name every column, `skip` for those "
             "that are not needed",
             table.file, reader.line_number(), values.size(), setting, columns.size(),
             fmt::join(columns, ", "));
    for (std::size_t c = 0; c < values.size(); ++c)
      validate(std::isfinite(values[c]), "{}:{}: column {} ({}) is {}", table.file,
               reader.line_number(), c + 1, columns[c], values[c]);
    table.rows.push_back(values);
    table.lines.push_back(reader.line_number());
  }
  validate(!table.rows.empty(), "{}: no rows (the file is empty)", table.file);
  if (!reader.terminated())
    table.notes.push_back(fmt::format("{}:{}: last line has no newline, taken as complete",
                                      table.file, reader.line_number()));
  return table;
}

// Position of each wanted name; -1 if absent and optional.
int column_of(const std::vector<std::string>& columns, std::string_view name,
              std::string_view setting, bool optional = false) {
  const auto found = std::find(columns.begin(), columns.end(), name);
  validate(optional || found != columns.end(), "`{}` lacks '{}'", setting, name);
  validate(found == columns.end() || std::find(found + 1, columns.end(), name) == columns.end(),
           "`{}` names '{}' twice", setting, name);
  return found == columns.end() ? -1 : static_cast<int>(found - columns.begin());
}

void check_names(const std::vector<std::string>& columns, const std::set<std::string>& known,
                 std::string_view setting) {
  for (const std::string& name : columns)
    validate(known.count(name) > 0, "`{}`: unknown column '{}' (known: {})", setting, name,
             fmt::join(known, ", "));
}

std::int64_t integer_at(const Table& table, std::size_t row, int column, std::string_view what) {
  const double value = table.rows[row][static_cast<std::size_t>(column)];
  validate(std::abs(value) <= kLargestExactInteger && value == std::nearbyint(value),
           "{}:{}: {} {} is not a whole number (column {}) is the order of the columns right?",
           table.file, table.lines[row], what, value, column + 1);
  return static_cast<std::int64_t>(value);
}

std::string list_tags(const std::vector<std::int64_t>& tags) {
  constexpr std::size_t kShown = 20;
  std::string text;
  for (std::size_t i = 0; i < tags.size() && i < kShown; ++i)
    text += fmt::format("{}{}", i == 0 ? "" : ", ", tags[i]);
  return tags.size() > kShown ? text + ", ..." : text;
}

using TagRows = std::unordered_map<std::int64_t, std::size_t>;

void insert_tag(TagRows& rows, std::int64_t tag, std::size_t row, const Table& table,
                std::string_view noun) {
  const auto [it, inserted] = rows.emplace(tag, row);
  validate(inserted, "{}:{}: {} {} was already given in line {}", table.file, table.lines[row],
           noun, tag, table.lines[it->second]);
}

std::vector<std::size_t> ordered_rows(const std::vector<std::int64_t>& tags, RecorderOrder order,
                                      const Table& table, std::vector<std::string>& notes) {
  std::vector<std::size_t> rows(tags.size());
  std::iota(rows.begin(), rows.end(), std::size_t{0});
  if (order == RecorderOrder::tag) {
    std::sort(rows.begin(), rows.end(),
              [&](std::size_t a, std::size_t b) { return tags[a] < tags[b]; });
  } else if (!std::is_sorted(tags.begin(), tags.end())) {
    notes.push_back(fmt::format(
        "{}: tags do not ascend; recorder columns are taken in the order of its rows", table.file));
  }
  return rows;
}

void read_nodes(const MeshTextConfig& config, double length, MeshText& out, TagRows& node_index,
                std::string& file) {
  constexpr std::string_view setting = "node_columns";
  check_names(config.node_columns, {"tag", "x", "y", "skip"}, setting);
  const int tag = column_of(config.node_columns, "tag", setting);
  const int x = column_of(config.node_columns, "x", setting);
  const int y = column_of(config.node_columns, "y", setting);
  const Table table = read_table(config.nodes.path, config.node_columns, setting);
  file = table.file;
  out.notes.insert(out.notes.end(), table.notes.begin(), table.notes.end());

  std::vector<std::int64_t> tags;
  TagRows seen;
  for (std::size_t r = 0; r < table.rows.size(); ++r) {
    tags.push_back(integer_at(table, r, tag, "node number"));
    insert_tag(seen, tags.back(), r, table, "node");
  }
  for (const std::size_t r : ordered_rows(tags, config.recorder_order, table, out.notes)) {
    const std::vector<double>& row = table.rows[r];
    node_index.emplace(tags[r], out.mesh.nodes.size());
    out.mesh.node_tags.push_back(tags[r]);
    out.mesh.nodes.push_back(
        {length * row[static_cast<std::size_t>(x)], length * row[static_cast<std::size_t>(y)]});
  }
  std::vector<Vec2> sorted = out.mesh.nodes;
  std::sort(sorted.begin(), sorted.end());
  std::ptrdiff_t coincident = 0;
  for (std::size_t i = 1; i < sorted.size(); ++i) coincident += sorted[i] == sorted[i - 1];
  if (coincident > 0)
    out.notes.push_back(
        fmt::format("{}: {} nodes lie on another node (interfaces?)", table.file, coincident));
}

// Twice the signed areas of the triangles at the four corners: the Jacobian there, up to a factor.
std::array<double, 4> corner_areas(const std::array<Vec2, 4>& q) {
  std::array<double, 4> a{};
  for (std::size_t i = 0; i < 4; ++i) {
    const Vec2& p = q[(i + 3) % 4];
    const Vec2& c = q[i];
    const Vec2& n = q[(i + 1) % 4];
    a[i] = (n[0] - c[0]) * (p[1] - c[1]) - (n[1] - c[1]) * (p[0] - c[0]);
  }
  return a;
}

void check_shapes(MeshText& out, const std::string& file, bool reverse_clockwise) {
  std::vector<std::int64_t> repeated;
  std::vector<std::int64_t> clockwise;
  std::vector<std::int64_t> folded;
  for (std::size_t e = 0; e < out.mesh.num_elements(); ++e) {
    auto& nodes = out.mesh.elements[e];
    const std::int64_t tag = out.mesh.element_tags[e];
    if (std::set<std::int32_t>(nodes.begin(), nodes.end()).size() < 4) {
      repeated.push_back(tag);
      continue;
    }
    const auto a = corner_areas(corners(out.mesh, out.mesh.nodes, e));
    const auto positive = std::count_if(a.begin(), a.end(), [](double x) { return x > 0.0; });
    const auto negative = std::count_if(a.begin(), a.end(), [](double x) { return x < 0.0; });
    if (negative == 4) {
      clockwise.push_back(tag);
      if (reverse_clockwise) std::swap(nodes[1], nodes[3]);
    } else if (positive != 4) {
      folded.push_back(tag);
    }
  }
  validate(repeated.empty(),
           "{}: {} elements name a node twice ({}): triangles cannot be read as quadrilaterals",
           file, repeated.size(), list_tags(repeated));
  validate(folded.empty(),
           "{}: {} elements are folded or not convex ({}): their Jacobian is not positive at every "
           "corner. Check the order of their nodes",
           file, folded.size(), list_tags(folded));
  if (clockwise.empty()) return;
  validate(
      reverse_clockwise, "{}: {} elements run clockwise ({}): their volumes would be negative. {}",
      file, clockwise.size(), list_tags(clockwise),
      clockwise.size() == out.mesh.num_elements()
          ? "All of them do: does y point downwards, or are x and y exchanged? Then the section "
            "would lie upside down; change the coordinates. Only if they are right and the "
            "nodes are listed the other way round, set `reverse_clockwise: true`"
          : "Check the columns n1..n4, or set `reverse_clockwise: true` if only their nodes "
            "are listed the other way round");
  out.notes.push_back(
      fmt::format("{}: {} clockwise elements were reversed", file, clockwise.size()));
}

void read_elements(const MeshTextConfig& config, const TagRows& node_index,
                   const std::string& node_file, MeshText& out) {
  constexpr std::string_view setting = "element_columns";
  check_names(config.element_columns, {"tag", "n1", "n2", "n3", "n4", "material", "skip"}, setting);
  const int tag = column_of(config.element_columns, "tag", setting);
  const int material = column_of(config.element_columns, "material", setting, true);
  std::array<int, 4> n{};
  for (int i = 0; i < 4; ++i)
    n[static_cast<std::size_t>(i)] =
        column_of(config.element_columns, fmt::format("n{}", i + 1), setting);
  const Table table = read_table(config.elements.path, config.element_columns, setting);
  out.notes.insert(out.notes.end(), table.notes.begin(), table.notes.end());
  if (material < 0)
    out.notes.push_back(fmt::format("{}: no material column, all elements get 0", table.file));

  std::vector<std::int64_t> tags;
  TagRows seen;
  for (std::size_t r = 0; r < table.rows.size(); ++r) {
    tags.push_back(integer_at(table, r, tag, "element number"));
    insert_tag(seen, tags.back(), r, table, "element");
  }
  for (const std::size_t r : ordered_rows(tags, config.recorder_order, table, out.notes)) {
    std::array<std::int32_t, 4> nodes{};
    for (std::size_t i = 0; i < 4; ++i) {
      const std::int64_t node = integer_at(table, r, n[i], "node number");
      const auto found = node_index.find(node);
      validate(found != node_index.end(), "{}:{}: element {} names node {}, which {} lacks",
               table.file, table.lines[r], tags[r], node, node_file);
      nodes[i] = static_cast<std::int32_t>(found->second);
    }
    const std::int64_t m = material < 0 ? 0 : integer_at(table, r, material, "material number");
    validate(std::abs(m) <= std::numeric_limits<std::int32_t>::max(),
             "{}:{}: material number {} is too large", table.file, table.lines[r], m);
    out.mesh.elements.push_back(nodes);
    out.mesh.element_tags.push_back(tags[r]);
    out.mesh.element_material.push_back(static_cast<std::int32_t>(m));
  }
  check_shapes(out, table.file, config.reverse_clockwise);
  const auto pairs = repeated_elements(out.mesh);
  validate(pairs.empty(),
           "{}: {} elements are given twice, such as {} and {} with the same nodes (their soil "
           "would count twice) remove one of each",
           table.file, pairs.size(), pairs.empty() ? 0 : out.mesh.element_tags[pairs[0][0]],
           pairs.empty() ? 0 : out.mesh.element_tags[pairs[0][1]]);
}

}  // namespace

void Schema<MeshTextConfig>::describe(FieldVisitor& v, MeshTextConfig& c) {
  v.file("nodes", c.nodes, "table of nodes");
  v.file("elements", c.elements, "table of elements");
  v.texts("node_columns", c.node_columns, "columns of the node table: tag, x, y, skip");
  v.texts("element_columns", c.element_columns,
          "columns of the element table: tag, n1, n2, n3, n4 (counter-clockwise), material, skip");
  v.choice("recorder_order", c.recorder_order, kRecorderOrders,
           "order of recorder columns: rows of the mesh files, or ascending tags");
  v.flag("reverse_clockwise", c.reverse_clockwise,
         "reverse clockwise elements instead of refusing");
}

MeshText read_mesh_text(const MeshTextConfig& config, double length) {
  MeshText out;
  TagRows node_index;
  std::string node_file;
  read_nodes(config, length, out, node_index, node_file);
  read_elements(config, node_index, node_file, out);
  check(out.mesh);
  return out;
}

}  // namespace flowslide
