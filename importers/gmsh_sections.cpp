#include "importers/gmsh_sections.hpp"

#include "core/odd_characters.hpp"
#include "core/units.hpp"
#include "importers/text_lines.hpp"

#include <cmath>
#include <limits>

#include <fmt/format.h>

namespace flowslide {
namespace {

/// Lines of a .msh file as numbers, with their place for messages.
class Lines {
 public:
  explicit Lines(const std::filesystem::path& path) : reader_(path) {}

  bool next() {
    while (reader_.next(line_)) {
      const auto first = line_.find_first_not_of(" \t");
      if (first == std::string_view::npos) continue;
      line_.remove_prefix(first);
      while (line_.back() == ' ' || line_.back() == '\t') line_.remove_suffix(1);
      return true;
    }
    return false;
  }
  [[nodiscard]] std::string_view text() const { return line_; }
  [[nodiscard]] const std::string& name() const { return reader_.name(); }
  [[nodiscard]] std::int64_t number() const { return reader_.line_number(); }

  /// Numbers of the next line; at least `least` of them.
  const std::vector<double>& numbers(std::size_t least, std::string_view what) {
    if (!next()) fail(fmt::format("the file ends where {} should stand (it was cut)", what));
    if (split(line_, what).size() < least)
      fail(fmt::format("{} numbers, but {} has at least {}", values_.size(), what, least));
    return values_;
  }
  /// Numbers of a text with blanks between them.
  const std::vector<double>& split(std::string_view text, std::string_view what) {
    values_.clear();
    std::string_view rest = text;
    while (!rest.empty()) {
      double value = 0.0;
      std::size_t length = 0;
      if (!parse_number(rest, value, length) || !std::isfinite(value)) fail(no_numbers(what));
      values_.push_back(value);
      rest.remove_prefix(length);
      const auto first = rest.find_first_not_of(" \t");
      if (first == 0) fail(no_numbers(what));
      rest.remove_prefix(first == std::string_view::npos ? rest.size() : first);
    }
    return values_;
  }

  std::int64_t whole(double value, std::string_view what) const {
    if (value != std::floor(value) || std::abs(value) > kLargestExactInteger)
      fail(fmt::format("{} is no whole number ({})", value, what));
    return static_cast<std::int64_t>(value);
  }
  /// A number of gmsh's own, which are 32 bits wide: a larger one must not become a smaller.
  int tag(double value, std::string_view what) const {
    const std::int64_t n = whole(value, what);
    if (std::abs(n) > std::numeric_limits<int>::max())
      fail(fmt::format("{} {} is larger than gmsh writes", what, n));
    return static_cast<int>(n);
  }
  std::size_t count(double value, std::string_view what) const {
    const std::int64_t n = whole(value, what);
    if (n < 0 || n > 100'000'000) fail(fmt::format("{} {} (0 to 100 million)", n, what));
    return static_cast<std::size_t>(n);
  }
  [[noreturn]] void fail(const std::string& problem) const {
    throw InputError(fmt::format("{}:{}: {}", name(), number(), problem));
  }

 private:
  [[nodiscard]] std::string no_numbers(std::string_view what) const {
    const std::string odd = odd_characters(line_);
    return fmt::format("'{}' {}", line_.substr(0, 60),
                       odd.empty() ? fmt::format("is not {}", what) : odd);
  }

  LineReader reader_;
  std::string_view line_;
  std::vector<double> values_;
};

std::size_t nodes_of_type(int type) {
  switch (type) {
    case 15:
      return 1;
    case 1:
      return 2;
    case 2:
      return 3;
    case 3:
      return 4;
    default:
      return 0;
  }
}

void read_names(Lines& in, GmshFile& file) {
  const std::size_t n = in.count(in.numbers(1, "the number of physical names")[0], "names");
  for (std::size_t i = 0; i < n; ++i) {
    if (!in.next()) in.fail("the file ends inside $PhysicalNames (it was cut)");
    const std::string line(in.text());
    const auto from = line.find('"'), to = line.rfind('"');
    if (from == std::string::npos || to <= from)
      in.fail(fmt::format("'{}' is not: dimension, number, \"name\"", line));
    const std::vector<double>& v =
        in.split(std::string_view(line).substr(0, from), "a dimension and a number");
    if (v.size() != 2) in.fail(fmt::format("'{}' is not: dimension, number, \"name\"", line));
    const int dimension = in.tag(v[0], "dimension"), tag = in.tag(v[1], "physical group");
    const std::string name = line.substr(from + 1, to - from - 1);
    const auto [at, is_new] = file.physical_names.emplace(std::pair(dimension, tag), name);
    if (!is_new && at->second != name)
      in.fail(
          fmt::format("physical group {} of dimension {} is '{}', and was '{}' before (its "
                      "elements can have one name only) number one of them anew",
                      tag, dimension, name, at->second));
  }
}

/// Physical groups of each entity, 4.1 only.
using Entities = std::map<std::pair<int, std::int64_t>, std::vector<int>>;

Entities read_entities(Lines& in) {
  Entities physical;
  const std::vector<double> head = in.numbers(4, "numbers of points, curves, surfaces, volumes");
  for (int dimension = 0; dimension < 4; ++dimension) {
    const std::size_t n = in.count(head[static_cast<std::size_t>(dimension)], "entities");
    // Points have one corner of their box, the others two; then the physical groups.
    const std::size_t at = dimension == 0 ? 4 : 7;
    for (std::size_t i = 0; i < n; ++i) {
      const std::vector<double>& v = in.numbers(at + 1, "an entity");
      const std::size_t groups = in.count(v[at], "physical groups");
      if (v.size() < at + 1 + groups) in.fail("fewer physical groups than the line says");
      if (dimension == 2 && groups > 1)
        in.fail(
            fmt::format("surface {} is in {} physical groups (one material is needed) put it "
                        "into one",
                        v[0], groups));
      std::vector<int>& of_entity = physical[{dimension, in.whole(v[0], "entity")}];
      for (std::size_t g = 0; g < groups; ++g)
        of_entity.push_back(std::abs(in.tag(v[at + 1 + g], "physical group")));
    }
  }
  return physical;
}

void read_nodes_2(Lines& in, GmshFile& file) {
  const std::size_t n = in.count(in.numbers(1, "the number of nodes")[0], "nodes");
  for (std::size_t i = 0; i < n; ++i) {
    const std::vector<double>& v = in.numbers(4, "a node: number, x, y, z");
    file.nodes.push_back({in.whole(v[0], "node"), v[1], v[2], v[3], in.number()});
  }
}

void read_nodes_4(Lines& in, GmshFile& file) {
  const std::vector<double> head = in.numbers(4, "blocks, nodes, smallest and largest number");
  for (std::size_t b = 0; b < in.count(head[0], "blocks of nodes"); ++b) {
    const std::vector<double> block = in.numbers(4, "dimension, entity, parametric, nodes");
    const std::size_t n = in.count(block[3], "nodes");
    const std::size_t first = file.nodes.size();
    for (std::size_t i = 0; i < n; ++i)
      file.nodes.push_back({in.whole(in.numbers(1, "a node number")[0], "node"), 0, 0, 0, 0});
    for (std::size_t i = 0; i < n; ++i) {
      const std::vector<double>& v = in.numbers(3, "x, y, z of a node");
      GmshNode& node = file.nodes[first + i];
      node = {node.tag, v[0], v[1], v[2], in.number()};
    }
  }
}

void add_element(Lines& in, GmshFile& file, const std::vector<double>& v, std::size_t first,
                 int type, int physical) {
  GmshElement e{in.whole(v[0], "element"), type, physical, {}, in.number()};
  const std::size_t n = nodes_of_type(type);
  if (v.size() < first + n)
    in.fail(fmt::format("element {} has {} nodes, its type {} has {}", e.tag, v.size() - first,
                        type, n));
  for (std::size_t k = 0; k < n; ++k) e.nodes.push_back(in.whole(v[first + k], "node"));
  file.elements.push_back(std::move(e));
}

void read_elements_2(Lines& in, GmshFile& file) {
  const std::size_t n = in.count(in.numbers(1, "the number of elements")[0], "elements");
  for (std::size_t i = 0; i < n; ++i) {
    const std::vector<double> v = in.numbers(3, "an element: number, type, number of tags, ...");
    const std::size_t tags = in.count(v[2], "tags");
    if (v.size() < 3 + tags) in.fail("fewer tags than the line says");
    const int physical = tags > 0 ? in.tag(v[3], "physical group") : 0;
    add_element(in, file, v, 3 + tags, in.tag(v[1], "type"), physical);
  }
}

void read_elements_4(Lines& in, GmshFile& file, const Entities& entities) {
  const std::vector<double> head = in.numbers(4, "blocks, elements, smallest and largest number");
  for (std::size_t b = 0; b < in.count(head[0], "blocks of elements"); ++b) {
    const std::vector<double> block = in.numbers(4, "dimension, entity, type, elements");
    const auto group = entities.find({in.tag(block[0], "dimension"), in.whole(block[1], "entity")});
    const int type = in.tag(block[2], "type");
    const std::vector<int> groups =
        group == entities.end() || group->second.empty() ? std::vector<int>{0} : group->second;
    for (std::size_t i = 0; i < in.count(block[3], "elements"); ++i) {
      const std::vector<double>& v = in.numbers(1, "an element: number and nodes");
      // Once for each group, as format 2.2 has it.
      for (const int physical : groups) add_element(in, file, v, 1, type, physical);
    }
  }
}

int read_format(Lines& in) {
  const std::vector<double>& v = in.numbers(3, "version, file type, data size");
  if (v[1] != 0.0) in.fail("a binary .msh file (only text is read). Save it with Mesh.Binary = 0");
  if (v[0] == 2.2 || v[0] == 2.1 || v[0] == 2.0) return 2;
  if (v[0] == 4.1) return 4;
  in.fail(
      fmt::format("format {} (2.2 and 4.1 are read). Save it with Mesh.MshFileVersion = 2.2 or "
                  "4.1",
                  v[0]));
}

/// Goes to the end of a section; one that was read must end where its counts say.
void finish_section(Lines& in, const std::string& name, bool was_read) {
  const std::string end = "$End" + name;
  do {
    if (!in.next()) in.fail("the file ends inside $" + name + " (it was cut)");
    if (was_read && in.text() != end)
      in.fail(fmt::format("'{}' where {} should stand (${} has more lines than it says)",
                          in.text().substr(0, 40), end, name));
  } while (in.text() != end);
}

}  // namespace

GmshFile read_gmsh_file(const std::filesystem::path& path) {
  Lines in(path);
  GmshFile file;
  file.name = in.name();
  int version = 0;
  bool has_names = false;
  Entities entities;
  while (in.next()) {
    if (in.text().front() != '$')
      in.fail(
          fmt::format("'{}' where a section such as $MeshFormat should start (is this a .msh "
                      "file of gmsh?)",
                      in.text().substr(0, 40)));
    const std::string section(in.text().substr(1));
    if (section != "MeshFormat" && version == 0)
      in.fail("the first section is not $MeshFormat (is this a .msh file of gmsh?)");
    bool known = true;
    if (section == "MeshFormat")
      version = read_format(in);
    else if (section == "PhysicalNames") {
      if (has_names)
        in.fail(
            "a second $PhysicalNames (which names hold is not clear: were two files put together?) "
            "keep one of them");
      has_names = true;
      read_names(in, file);
    } else if (section == "Entities" && version == 4)
      entities = read_entities(in);
    else if (section == "Nodes")
      version == 4 ? read_nodes_4(in, file) : read_nodes_2(in, file);
    else if (section == "Elements")
      version == 4 ? read_elements_4(in, file, entities) : read_elements_2(in, file);
    else
      known = false;
    finish_section(in, section, known);
  }
  validate(!file.nodes.empty() && !file.elements.empty(),
           "{}: {} nodes and {} elements (the mesh is empty). Mesh the geometry in gmsh before "
           "saving",
           file.name, file.nodes.size(), file.elements.size());
  return file;
}

}  // namespace flowslide
