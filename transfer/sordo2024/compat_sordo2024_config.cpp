#include "core/conventions.hpp"
#include "transfer/sordo2024/compat_sordo2024.hpp"

#include <algorithm>
#include <cmath>

namespace flowslide {
namespace {

constexpr std::array<FieldVisitor::Column, 2> kPointColumns{
    {{"x", Dim::length}, {"y", Dim::length}}};
constexpr std::array<FieldVisitor::Column, 2> kLayerColumns{
    {{"sigma'_v0 from", Dim::stress}, {"tag", Dim::none}}};
constexpr std::array<FieldVisitor::Column, 7> kStrengthColumns{{{"tag", Dim::none},
                                                                {"phi peak", Dim::angle},
                                                                {"phi residual", Dim::angle},
                                                                {"c peak", Dim::stress},
                                                                {"c residual", Dim::stress},
                                                                {"strain peak", Dim::none},
                                                                {"strain residual", Dim::none}}};

constexpr double kDegree = kPi / 180.0;

void check_tags(std::string_view key, const std::vector<std::vector<double>>& rows,
                std::size_t column) {
  std::vector<double> tags;
  for (const std::vector<double>& row : rows) {
    const double tag = row[column];
    validate(tag == std::floor(tag) && tag > 0.0 && tag < 1e9,
             "{}: the material tag {} is not a positive whole number (tags are compared "
             "for equality) correct the row",
             key, tag);
    validate(std::find(tags.begin(), tags.end(), tag) == tags.end(),
             "{}: tag {} has two rows (only one can hold) remove one", key, tag);
    tags.push_back(tag);
  }
}

}  // namespace

SordoConfig::SordoConfig()
    : layers{{0.0, 176},   {50e3, 175},  {100e3, 174}, {150e3, 173},
             {200e3, 172}, {250e3, 171}, {300e3, 169}},
      strengths{{166, 35 * kDegree, 20 * kDegree, 20e3, 1e3, 0.01, 0.05},
                {167, 35 * kDegree, 20 * kDegree, 20e3, 1e3, 0.01, 0.05},
                {168, 30 * kDegree, 0, 1e3, 5e3, 0, 1},
                {169, 0, 0, 12e3, 6e3, 0, 1},
                {171, 0, 0, 11.5e3, 5.75e3, 0, 1},
                {172, 0, 0, 10.6e3, 5.3e3, 0, 1},
                {173, 0, 0, 9.1e3, 4.55e3, 0, 1},
                {174, 0, 0, 7.4e3, 3.7e3, 0, 1},
                {175, 0, 0, 5.6e3, 2.8e3, 0, 1},
                {176, 0, 0, 3e3, 1.5e3, 0, 1}},
      densities{{167, 1690.0}, {168, 1870.0}, {170, 1900.0}} {}

void Schema<SordoConfig>::describe(FieldVisitor& v, SordoConfig& c) {
  v.moved("frame",
          "(the moment is that of transfer.zone) remove it, and write 'when: at, at: 7.01 s' or "
          "'when: gravity' there");
  v.integer("base_node", c.base_node, {.min = 1}, "tag of the bottom left node of the dam");
  v.text("tailings", c.soils.tailings, "material of the section that is the tailings");
  v.text("embankment", c.soils.embankment, "material of the section that is the embankment");
  v.text("foundation", c.soils.foundation,
         "material of the section that is the elastic foundation");
  v.integer("saturated_embankment", c.saturated_embankment, {.min = 1},
            "tag given to embankment under the water table");
  v.tuple("keep_x", c.keep_x, Dim::length, "points outside this range of x are dropped");
  v.tuple("keep_y", c.keep_y, Dim::length, "points outside this range of y are dropped");
  v.quantity("water_slope", c.water_slope, Dim::none, {}, "slope of the water table");
  v.quantity("water_level", c.water_level, Dim::length, {}, "level of the water table at x = 0");
  v.quantity("r_u", c.r_u, Dim::none, {.above = 0.0}, "tailings with more are liquefied");
  v.choice("liquefied", c.liquefied, kSordoLiquefiedNames,
           "all tailings, or those above the line and above r_u");
  v.rows("line", c.line, kPointColumns,
         "two points, upstream first, of the lower limit of the "
         "liquefied tailings; level upstream of the first");
  v.quantity("youngs_modulus", c.youngs_modulus, Dim::stress, {.above = 0.0},
             "Young's modulus of all materials in the runout");
  v.quantity("poisson_ratio", c.poisson_ratio, Dim::none, {.min = 0.0, .below = 0.5},
             "Poisson's ratio of all materials in the runout");
  v.moved(
      "densities",
      "(the shaking brings the densities of its materials) remove it; they are those of fem.run, "
      "or of import.opensees with 'materials: {tailings: {tag: 168, density: 1870 kg/m3}}'");
  v.rows("layers", c.layers, kLayerColumns,
         "liquefied layers: smallest initial vertical effective stress, tag");
  v.rows("strengths", c.strengths, kStrengthColumns, "Mohr-Coulomb strength of each tag");
}

SordoConfig for_history(SordoConfig c, const FemHistory& history, int frame) {
  c.frame = frame;
  c.tailings = find_material(history.materials(), c.soils.tailings, "tailings").tag;
  c.embankment = find_material(history.materials(), c.soils.embankment, "embankment").tag;
  c.foundation = find_material(history.materials(), c.soils.foundation, "foundation").tag;
  c.densities.clear();
  for (const HistoryMaterial& m : history.materials())
    c.densities.push_back({static_cast<double>(m.tag), m.density});
  return c;
}

void check(const SordoConfig& c) {
  check_tags("densities", c.densities, 0);
  check_tags("layers", c.layers, 1);
  check_tags("strengths", c.strengths, 0);
  for (const std::vector<double>& row : c.densities) {
    validate(row[1] > 0.0, "densities: {} kg/m3 of tag {} is not positive", row[1], row[0]);
  }
  validate(!c.layers.empty(), "layers is empty (liquefied tailings need a tag) give rows");
  for (std::size_t i = 1; i < c.layers.size(); ++i) {
    validate(c.layers[i][0] > c.layers[i - 1][0],
             "layers: row {} starts at {} Pa, not deeper than the row before (layers are "
             "read from the surface down) sort the rows",
             i + 1, c.layers[i][0]);
  }
  for (const std::vector<double>& row : c.strengths) {
    validate(row[1] >= 0.0 && row[1] < kPi / 2 && row[2] >= 0.0 && row[2] < kPi / 2,
             "strengths: a friction angle of tag {} is outside 0 to 90 deg", row[0]);
    validate(row[3] >= 0.0 && row[4] >= 0.0, "strengths: a cohesion of tag {} is negative", row[0]);
    validate(row[5] >= 0.0 && row[6] > row[5],
             "strengths: tag {} softens from strain {} to {} (the second must be larger)", row[0],
             row[5], row[6]);
  }
  validate(c.keep_x[0] < c.keep_x[1] && c.keep_y[0] < c.keep_y[1],
           "keep_x or keep_y is empty (the smaller limit comes first)");
  if (c.liquefied == SordoLiquefied::line) {
    validate(c.line.size() == 2 && c.line[0][0] < c.line[1][0],
             "line must hold two points, the upstream one first (liquefied: line divides "
             "the tailings by them) write line: [[-31 m, 5 m], [3.5 m, 3 m]]");
  } else {
    validate(c.line.empty(),
             "line is given but liquefied is 'all' (the line would be ignored) remove it "
             "or write liquefied: line");
  }
}

}  // namespace flowslide
