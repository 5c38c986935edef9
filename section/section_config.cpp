#include "section/section_config.hpp"

#include "core/check.hpp"
#include "section/outline.hpp"

#include <algorithm>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace flowslide {

constexpr std::array<FieldVisitor::Column, 2> kPoint{{{"x", Dim::length}, {"y", Dim::length}}};
constexpr std::array<FieldVisitor::Column, 2> kSizeAt{{{"x", Dim::length}, {"size", Dim::length}}};

template <>
struct Schema<SectionMaterial> {
  static constexpr std::string_view doc = "A material.";
  static void describe(FieldVisitor& v, SectionMaterial& c) {
    v.integer("tag", c.tag, {.min = 1, .max = 1e9}, "number of the material in the mesh, unique");
  }
};

template <>
struct Schema<SectionBlock> {
  static constexpr std::string_view doc = "A part of the section, meshed as a grid.";
  static void describe(FieldVisitor& v, SectionBlock& c) {
    v.rows("outline", c.outline, kPoint, "points, counter-clockwise");
    v.integers(
        "corners", c.corners,
        "which points of the outline are corners, from 1; needed with more than four points. "
        "Three corners: the block is divided into three grids");
    v.text("material", c.material, "one of `materials`");
    v.quantity("size", c.size, Dim::length, {.above = 0.0},
               "target size of its elements, instead of that of the section");
    v.integers("divisions", c.divisions,
               "elements along its first side (from the first corner to the second) and along its "
               "second, 0 for by size");
  }
};

template <>
struct Schema<SectionZone> {
  static constexpr std::string_view doc = "A polygon of another material.";
  static void describe(FieldVisitor& v, SectionZone& c) {
    v.rows("outline", c.outline, kPoint, "points, in either direction");
    v.text("material", c.material, "one of `materials`");
  }
};

template <>
struct Schema<SectionSet> {
  static constexpr std::string_view doc = "Element edges along a line.";
  static void describe(FieldVisitor& v, SectionSet& c) {
    v.rows("line", c.line, kPoint,
           "points of a line along sides of blocks; elements end at its points");
  }
};

void Schema<SectionConfig>::describe(FieldVisitor& v, SectionConfig& c) {
  v.quantity("size", c.size, Dim::length, {.above = 0.0}, "target size of elements");
  v.rows("size_along_x", c.size_along_x, kSizeAt,
         "target size against x (rising), straight between the rows; the end values hold beyond; "
         "takes the place of `size`");
  v.table("materials", c.materials, "names of materials");
  v.table("blocks", c.blocks, "parts of the section");
  v.table("zones", c.zones, "polygons whose elements get another material");
  v.table("sets", c.sets,
          "named edges, beside `base`, `right`, `surface` and `left`, which the program finds");
}

Vec2 to_point(const std::vector<double>& row) { return {row.at(0), row.at(1)}; }

std::vector<Vec2> to_points(const PointRows& rows) {
  std::vector<Vec2> points;
  points.reserve(rows.size());
  for (const auto& row : rows) points.push_back(to_point(row));
  return points;
}

double size_at(const SectionConfig& config, double x) {
  const PointRows& rows = config.size_along_x;
  if (rows.empty()) return config.size;
  if (x <= rows.front()[0]) return rows.front()[1];
  for (std::size_t i = 1; i < rows.size(); ++i)
    if (x <= rows[i][0]) {
      const double t = (x - rows[i - 1][0]) / (rows[i][0] - rows[i - 1][0]);
      return rows[i - 1][1] + t * (rows[i][1] - rows[i - 1][1]);
    }
  return rows.back()[1];
}

namespace {

std::string material_names(const SectionConfig& config) {
  std::vector<std::string> names;
  for (const auto& [name, unused] : config.materials) names.push_back(name);
  return fmt::format("{}", fmt::join(names, ", "));
}

void check_material(const SectionConfig& config, const std::string& where,
                    const std::string& material) {
  validate(config.materials.count(material) > 0,
           "{}: there is no material '{}' (known: {}). Add it to `materials` or correct the name",
           where, material, material_names(config));
}

void check_outline(const std::string& where, const std::vector<Vec2>& outline, std::size_t least) {
  validate(outline.size() >= least, "{}: its outline has {} points (it needs at least {})", where,
           outline.size(), least);
  for (std::size_t i = 0; i < outline.size(); ++i)
    validate(distance(outline[i], outline[(i + 1) % outline.size()]) > 0.0,
             "{}: its outline has the point ({}, {}) twice in a row (a side of no length). Delete "
             "one; the outline closes by itself",
             where, outline[i][0], outline[i][1]);
  if (const auto at = self_contact(outline))
    throw InputError(fmt::format(
        "{}: its outline touches or crosses itself at ({:.6g}, {:.6g}) (it encloses no single "
        "area). List the points in the order in which you would walk around it",
        where, (*at)[0], (*at)[1]));
}

void check_corners(const std::string& where, const SectionBlock& block) {
  const std::size_t n = block.outline.size();
  validate(!block.corners.empty() || n <= 4,
           "{}: its outline has {} points (a block has three or four corners). Say which points "
           "are the corners, such as corners: [1, 2, 3, {}]; the others are points on its sides",
           where, n, n);
  const std::size_t corners = block.corners.empty() ? n : block.corners.size();
  validate(corners == 3 || corners == 4, "{}: corners: {} are named (a block has three or four)",
           where, corners);
  for (std::size_t i = 0; i < block.corners.size(); ++i)
    validate(block.corners[i] >= 1 && block.corners[i] <= static_cast<int>(n) &&
                 (i == 0 || block.corners[i] > block.corners[i - 1]),
             "{}: corners: [{}] (they are positions in the outline, which has {} points, from 1 "
             "and rising)",
             where, fmt::join(block.corners, ", "), n);
  validate(corners == 4 || block.divisions.empty(),
           "{}: divisions of a block with three corners (it is made of three grids). Leave them "
           "out, or divide it into blocks of four corners",
           where);
}

void check_block(const SectionConfig& config, const std::string& name, const SectionBlock& block) {
  const std::string where = fmt::format("block '{}'", name);
  const std::vector<Vec2> outline = to_points(block.outline);
  check_outline(where, outline, 3);
  validate(outline_area(outline) > 0.0,
           "{}: its outline runs clockwise (its elements would be turned inside out). List its "
           "points in the opposite order",
           where);
  check_corners(where, block);
  check_material(config, where, block.material);
  validate(block.divisions.empty() || block.divisions.size() == 2,
           "{}: divisions: {} numbers (two are needed: along the first side and the second)", where,
           block.divisions.size());
  for (const int n : block.divisions)
    validate(n >= 0, "{}: divisions: {} (a side has at least one element; 0 means by size)", where,
             n);
}

void check_sizes(const SectionConfig& config) {
  for (std::size_t i = 0; i < config.size_along_x.size(); ++i) {
    const auto& row = config.size_along_x[i];
    validate(row[1] > 0.0, "size_along_x: the size at x = {} m is {} m (it must be positive)",
             row[0], row[1]);
    validate(i == 0 || row[0] > config.size_along_x[i - 1][0],
             "size_along_x: x = {} m after {} m (x must rise)", row[0],
             i == 0 ? 0.0 : config.size_along_x[i - 1][0]);
  }
}

}  // namespace

void check(const SectionConfig& config) {
  validate(!config.blocks.empty(), "blocks: there are none (nothing to mesh)");
  check_sizes(config);
  std::set<int> tags;
  for (const auto& [name, material] : config.materials) {
    validate(material.tag >= 1,
             "material '{}' has no tag (later stages choose soil by it). Give it a number, such as "
             "tag: 168",
             name);
    validate(tags.insert(material.tag).second,
             "material '{}': tag {} is that of another material (their elements could not be told "
             "apart); give it its own",
             name, material.tag);
  }
  for (const auto& [name, block] : config.blocks) check_block(config, name, block);
  for (const auto& [name, zone] : config.zones) {
    check_outline(fmt::format("zone '{}'", name), to_points(zone.outline), 3);
    check_material(config, fmt::format("zone '{}'", name), zone.material);
  }
  for (const auto& [name, set] : config.sets) {
    validate(name != "base" && name != "right" && name != "surface" && name != "left",
             "set '{}': the program makes the set of this name itself. Choose another name", name);
    validate(set.line.size() >= 2, "set '{}': its line has {} points (it needs two or more)", name,
             set.line.size());
    for (std::size_t i = 1; i < set.line.size(); ++i)
      validate(distance(to_point(set.line[i - 1]), to_point(set.line[i])) > 0.0,
               "set '{}': its line has the point ({}, {}) twice in a row. Delete one", name,
               set.line[i][0], set.line[i][1]);
  }
}

}  // namespace flowslide
