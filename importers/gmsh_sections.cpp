#include "importers/gmsh_sections.hpp"

#include "importers/gmsh_lines.hpp"

#include <algorithm>
#include <limits>

#include <fmt/format.h>

namespace flowslide {
namespace {

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

void read_names(GmshLines& in, GmshFile& file) {
  const std::size_t n = in.count(in.exactly(1, "the number of physical names")[0], "names");
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

Entities read_entities(GmshLines& in) {
  Entities physical;
  const std::vector<double> head = in.exactly(4, "numbers of points, curves, surfaces, volumes");
  for (int dimension = 0; dimension < 4; ++dimension) {
    const std::size_t n = in.count(head[static_cast<std::size_t>(dimension)], "entities");
    // Points have one corner of their box, the others two; then the physical groups.
    const std::size_t at = dimension == 0 ? 4 : 7;
    for (std::size_t i = 0; i < n; ++i) {
      const std::vector<double>& v = in.numbers(at + 1, "an entity");
      const std::size_t groups = in.count(v[at], "physical groups");
      const std::size_t end = at + 1 + groups;
      if (v.size() < end) in.fail("fewer physical groups than the line says");
      // Then, of all but points, what it is bounded by; some writers leave this out.
      const bool bounded = dimension > 0 && v.size() > end;
      in.expect(bounded ? end + 1 + in.count(v[end], "parts of a boundary") : end,
                "an entity with these counts");
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

void read_nodes_2(GmshLines& in, GmshFile& file) {
  const std::size_t n = in.count(in.exactly(1, "the number of nodes")[0], "nodes");
  for (std::size_t i = 0; i < n; ++i) {
    const std::vector<double>& v = in.exactly(4, "a node: number, x, y, z,");
    file.nodes.push_back({in.whole(v[0], "node"), v[1], v[2], v[3], in.number()});
  }
}

/// The first line of a section of format 4.1: what its blocks hold together.
struct Totals {
  std::size_t blocks, items;
  double least, most;  ///< numbers of the items
  std::int64_t line;
};

Totals read_totals(GmshLines& in, std::string_view what) {
  const std::vector<double>& head =
      in.exactly(4, fmt::format("blocks, {}, smallest and largest number,", what));
  return {in.count(head[0], fmt::format("blocks of {}", what)), in.count(head[1], what), head[2],
          head[3], in.number()};
}

/// What the first line says against what came: a file that was cut, edited or put together.
void check_totals(const Totals& totals, std::string_view what, std::size_t found, double least,
                  double most, GmshFile& file) {
  validate(
      found == totals.items,
      "{}:{}: {} {}, and the blocks after it have {} (the file was edited, or put together from "
      "several: which is right is not known) save the mesh anew",
      file.name, totals.line, totals.items, what, found);
  if (found > 0 && (least != totals.least || most != totals.most))
    file.notes.push_back(fmt::format(
        "{}:{}: the numbers of {} are said to go from {:.15g} to {:.15g}, and go from {:.15g} to "
        "{:.15g}. Was the file edited?",
        file.name, totals.line, what, totals.least, totals.most, least, most));
}

/// Smallest and largest of the numbers that were seen.
struct Extent {
  double least = std::numeric_limits<double>::infinity(), most = -least;
  void add(double value) {
    least = std::min(least, value);
    most = std::max(most, value);
  }
};

void read_nodes_4(GmshLines& in, GmshFile& file) {
  const Totals totals = read_totals(in, "nodes");
  Extent tags;
  const std::size_t before = file.nodes.size();
  for (std::size_t b = 0; b < totals.blocks; ++b) {
    const std::vector<double> block = in.exactly(4, "dimension, entity, parametric, nodes");
    const std::size_t n = in.count(block[3], "nodes"), first = file.nodes.size();
    // Parametric ones have their coordinates on the entity as well.
    const std::size_t coordinates =
        3 + (block[2] != 0.0 ? in.count(block[0], "dimensions of an entity") : 0);
    for (std::size_t i = 0; i < n; ++i) {
      const double tag = in.exactly(1, "a node number")[0];
      file.nodes.push_back({in.whole(tag, "node"), 0, 0, 0, 0});
      tags.add(tag);
    }
    for (std::size_t i = 0; i < n; ++i) {
      const std::vector<double>& v = in.exactly(coordinates, "x, y, z of a node");
      GmshNode& node = file.nodes[first + i];
      node = {node.tag, v[0], v[1], v[2], in.number()};
    }
  }
  check_totals(totals, "nodes", file.nodes.size() - before, tags.least, tags.most, file);
}

void add_element(GmshLines& in, GmshFile& file, const std::vector<double>& v, std::size_t first,
                 int type, int physical) {
  GmshElement e{in.whole(v[0], "element"), type, physical, {}, in.number()};
  const std::size_t n = nodes_of_type(type);
  // Other types are refused with what to do when all are read.
  if (v.size() < first + n || (n > 0 && v.size() > first + n))
    in.fail(fmt::format("element {} has {} nodes, its type {} has {}", e.tag, v.size() - first,
                        type, n));
  for (std::size_t k = 0; k < n; ++k) e.nodes.push_back(in.whole(v[first + k], "node"));
  file.elements.push_back(std::move(e));
}

void read_elements_2(GmshLines& in, GmshFile& file) {
  const std::size_t n = in.count(in.exactly(1, "the number of elements")[0], "elements");
  for (std::size_t i = 0; i < n; ++i) {
    const std::vector<double> v = in.numbers(3, "an element: number, type, number of tags, ...");
    const std::size_t tags = in.count(v[2], "tags");
    if (v.size() < 3 + tags) in.fail("fewer tags than the line says");
    const int physical = tags > 0 ? in.tag(v[3], "physical group") : 0;
    add_element(in, file, v, 3 + tags, in.tag(v[1], "type"), physical);
  }
}

void read_elements_4(GmshLines& in, GmshFile& file, const Entities& entities) {
  const Totals totals = read_totals(in, "elements");
  Extent tags;
  std::size_t found = 0;
  for (std::size_t b = 0; b < totals.blocks; ++b) {
    const std::vector<double> block = in.exactly(4, "dimension, entity, type, elements");
    const auto group = entities.find({in.tag(block[0], "dimension"), in.whole(block[1], "entity")});
    const int type = in.tag(block[2], "type");
    const std::vector<int> groups =
        group == entities.end() || group->second.empty() ? std::vector<int>{0} : group->second;
    const std::size_t n = in.count(block[3], "elements");
    for (std::size_t i = 0; i < n; ++i) {
      const std::vector<double>& v = in.numbers(1, "an element: number and nodes");
      tags.add(v[0]);
      // Once for each group, as format 2.2 has it.
      for (const int physical : groups) add_element(in, file, v, 1, type, physical);
    }
    found += n;
  }
  check_totals(totals, "elements", found, tags.least, tags.most, file);
}

int read_format(GmshLines& in) {
  const std::vector<double>& v = in.exactly(3, "version, file type, data size,");
  if (v[1] != 0.0) in.fail("a binary .msh file (only text is read). Save it with Mesh.Binary = 0");
  if (v[0] == 2.2 || v[0] == 2.1 || v[0] == 2.0) return 2;
  if (v[0] == 4.1) return 4;
  in.fail(
      fmt::format("format {} (2.2 and 4.1 are read). Save it with Mesh.MshFileVersion = 2.2 or "
                  "4.1",
                  v[0]));
}

/// Goes to the end of a section; one that was read must end where its counts say.
void finish_section(GmshLines& in, const std::string& name, bool was_read) {
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
  GmshLines in(path);
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
