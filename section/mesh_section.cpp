#include "section/mesh_section.hpp"

#include "core/check.hpp"
#include "section/block_grid.hpp"
#include "section/boundary.hpp"
#include "section/divisions.hpp"
#include "section/layout.hpp"
#include "section/outline.hpp"
#include "section/quality.hpp"
#include "section/triangles.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <set>

#include <fmt/format.h>

namespace flowslide {
namespace {

constexpr double kMostElements = 2e5;

void check_count(const Layout& layout, const SectionConfig& config) {
  double count = 0.0;
  for (const LayoutBlock& block : layout.blocks) {
    const std::vector<int>& given = config.blocks.at(block.name).divisions;
    double longest[2] = {0.0, 0.0};
    for (int side = 0; side < 4; ++side) {
      double n = 0.0;
      for (const DirectedSegment& s : block.sides[side]) n += layout.segments[s.segment].elements;
      if (!given.empty() && given[side % 2] > 0) n = given[side % 2];
      longest[side % 2] = std::max(longest[side % 2], n);
    }
    count += longest[0] * longest[1];
  }
  validate(count <= kMostElements,
           "the sizes ask for about {:.3g} elements (more than {:.0g}, which no run here could "
           "finish). Are the units of `size` right?",
           count, kMostElements);
}

/// Renumbers by x, then y; coordinates that differ by rounding alone count as equal.
void sort_by_place(QuadMesh& mesh, double tolerance) {
  const auto order = [tolerance](const std::vector<Vec2>& p) {
    std::vector<std::int32_t> rank(p.size());
    std::iota(rank.begin(), rank.end(), 0);
    std::vector<std::array<double, 2>> key(p.size());
    for (std::size_t i = 0; i < p.size(); ++i)
      key[i] = {std::round(p[i][0] / tolerance), std::round(p[i][1] / tolerance)};
    std::stable_sort(rank.begin(), rank.end(),
                     [&key](std::int32_t a, std::int32_t b) { return key[a] < key[b]; });
    return rank;
  };
  const std::vector<std::int32_t> nodes = order(mesh.nodes);
  std::vector<std::int32_t> new_index(nodes.size());
  std::vector<Vec2> positions(nodes.size());
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    new_index[nodes[i]] = static_cast<std::int32_t>(i);
    positions[i] = mesh.nodes[nodes[i]];
    mesh.node_tags.push_back(static_cast<std::int64_t>(i) + 1);
  }
  mesh.nodes = std::move(positions);
  for (auto& element : mesh.elements)
    for (std::int32_t& n : element) n = new_index[n];
  std::vector<Vec2> centres;
  for (std::size_t e = 0; e < mesh.num_elements(); ++e)
    centres.push_back(centroid(corners(mesh, mesh.nodes, e)));
  const QuadMesh old = mesh;
  const std::vector<std::int32_t> elements = order(centres);
  for (std::size_t e = 0; e < elements.size(); ++e) {
    mesh.elements[e] = old.elements[elements[e]];
    mesh.element_material[e] = old.element_material[elements[e]];
    mesh.element_tags.push_back(static_cast<std::int64_t>(e) + 1);
  }
}

void apply_zones(const SectionConfig& config, QuadMesh& mesh) {
  std::vector<std::string> owner(mesh.num_elements());
  for (const auto& [name, zone] : config.zones) {
    const std::vector<Vec2> outline = to_points(zone.outline);
    std::size_t count = 0;
    for (std::size_t e = 0; e < mesh.num_elements(); ++e) {
      const Vec2 centre = centroid(corners(mesh, mesh.nodes, e));
      if (!inside_outline(outline, centre)) continue;
      validate(owner[e].empty(),
               "zones '{}' and '{}' both hold the element at ({:.4g}, {:.4g}) (it can have one "
               "material). Part their outlines",
               owner[e], name, centre[0], centre[1]);
      owner[e] = name;
      mesh.element_material[e] = config.materials.at(zone.material).tag;
      ++count;
    }
    validate(count > 0,
             "zone '{}' holds the centre of no element (it lies outside the section or is smaller "
             "than an element). Correct its outline or refine the mesh",
             name);
  }
}

std::vector<MaterialName> used_materials(const SectionConfig& config, const QuadMesh& mesh) {
  const std::set<std::int32_t> used(mesh.element_material.begin(), mesh.element_material.end());
  std::vector<MaterialName> materials;
  for (const auto& [name, material] : config.materials)
    if (used.count(material.tag) > 0) materials.push_back({name, material.tag});
  std::sort(materials.begin(), materials.end(),
            [](const MaterialName& a, const MaterialName& b) { return a.tag < b.tag; });
  return materials;
}

/// Settings that had no part in the mesh.
std::vector<std::string> idle_settings(const SectionConfig& config, const SectionMesh& section) {
  std::vector<std::string> notes;
  double begin = std::numeric_limits<double>::infinity(), end = -begin;
  for (const Vec2& p : section.mesh.nodes) {
    begin = std::min(begin, p[0]);
    end = std::max(end, p[0]);
  }
  const PointRows& sizes = config.size_along_x;
  if (!sizes.empty() && (sizes.front()[0] > end || sizes.back()[0] < begin))
    notes.push_back(fmt::format(
        "size_along_x: goes from x = {:g} to {:g} m, and the section from {:g} to {:g} m: one size "
        "holds for all of it. Are numbers and unit right?",
        sizes.front()[0], sizes.back()[0], begin, end));
  if (!sizes.empty()) {
    // A size near the others is one that was left standing.
    constexpr double kNear = 2.0;
    const auto [least, most] =
        std::ranges::minmax(sizes, {}, [](const auto& row) { return row[1]; });
    if (config.size * kNear < least[1] || config.size > kNear * most[1])
      notes.push_back(fmt::format(
          "size: {:g} m has no part in the mesh, whose sizes are those of size_along_x, {:g} to {:g} "
          "m. Change these, or take one of the two settings away.",
          config.size, least[1], most[1]));
  }
  for (const auto& [name, material] : config.materials)
    if (std::ranges::none_of(section.materials,
                             [&n = name](const MaterialName& m) { return m.name == n; }))
      notes.push_back(fmt::format(
          "material '{}': no element has it. Does a zone or a block lie where it should?", name));
  return notes;
}

}  // namespace

SectionMesh mesh_section(const SectionConfig& given) {
  check(given);
  const SectionConfig config = split_triangles(given);
  const Layout layout = lay_out(config);
  check_count(layout, config);
  SectionMesh section;
  section.notes = layout.notes;
  QuadMesh& mesh = section.mesh;
  mesh = block_grids(layout, config, divide(layout, config));
  sort_by_place(mesh, layout.tolerance);
  apply_zones(config, mesh);
  section.materials = used_materials(config, mesh);
  add_outer_sets(section);
  for (const auto& [name, set] : config.sets)
    section.sets.push_back(edges_along(mesh, name, to_points(set.line), 10.0 * layout.tolerance));
  for (std::string& note : quality_notes(mesh, measure_quality(mesh)))
    section.notes.push_back(std::move(note));
  for (std::string& note : idle_settings(given, section)) section.notes.push_back(std::move(note));
  check(section);
  return section;
}

}  // namespace flowslide
