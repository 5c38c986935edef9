#include "section/slope.hpp"

#include "core/check.hpp"
#include "core/elementary.hpp"
#include "section/outline.hpp"

#include <algorithm>
#include <cmath>

namespace flowslide {
namespace {

void check_rising(const std::vector<Vec2>& line, const char* what) {
  for (std::size_t i = 1; i < line.size(); ++i)
    validate(line[i][0] > line[i - 1][0], "{}: x = {} after {} (x must rise)", what, line[i][0],
             line[i - 1][0]);
}

void check_soil(const SlopeSoil& soil) {
  validate(soil.unit_weight > 0.0, "soil '{}': unit weight {} N/m3 (it must be positive)",
           soil.name, soil.unit_weight);
  validate(soil.cohesion >= 0.0 && soil.friction >= 0.0 && soil.friction < 1.5,
           "soil '{}': cohesion {} Pa, friction {} rad (neither may be negative, and friction is "
           "below 1.5)",
           soil.name, soil.cohesion, soil.friction);
  validate(!soil.r_u || (*soil.r_u >= 0.0 && *soil.r_u < 1.0), "soil '{}': r_u = {} (0 to 1)",
           soil.name, soil.r_u.value_or(0.0));
  for (std::size_t i = 1; i < soil.residual.size(); ++i)
    validate(soil.residual[i].stress > soil.residual[i - 1].stress,
             "soil '{}': sigma'_v of its residual strength must rise", soil.name);
}

double interpolate(const std::vector<StrengthPoint>& table, double stress) {
  if (stress <= table.front().stress) return table.front().strength;
  for (std::size_t i = 1; i < table.size(); ++i)
    if (stress <= table[i].stress) {
      const double t = (stress - table[i - 1].stress) / (table[i].stress - table[i - 1].stress);
      return table[i - 1].strength + t * (table[i].strength - table[i - 1].strength);
    }
  return table.back().strength;
}

}  // namespace

double height_at(const std::vector<Vec2>& line, double x) {
  if (x <= line.front()[0]) return line.front()[1];
  for (std::size_t i = 1; i < line.size(); ++i)
    if (x <= line[i][0]) {
      const double t = (x - line[i - 1][0]) / (line[i][0] - line[i - 1][0]);
      return line[i - 1][1] + t * (line[i][1] - line[i - 1][1]);
    }
  return line.back()[1];
}

std::vector<Vec2> above_level(const std::vector<Vec2>& outline, double y) {
  std::vector<Vec2> part;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Vec2 a = outline[i], b = outline[(i + 1) % outline.size()];
    if (a[1] >= y) part.push_back(a);
    if ((a[1] >= y) != (b[1] >= y))
      part.push_back({a[0] + (y - a[1]) / (b[1] - a[1]) * (b[0] - a[0]), y});
  }
  return part;
}

void check(const SlopeModel& model) {
  validate(model.ground.size() >= 2, "the ground has {} points (it needs at least two)",
           model.ground.size());
  check_rising(model.ground, "ground");
  check_rising(model.water_table, "water table");
  for (const SlopeSoil& soil : model.soils) check_soil(soil);
  for (const SlopeZone& zone : model.zones)
    validate(zone.soil < model.soils.size() && zone.outline.size() >= 3,
             "a zone has soil {} of {} and an outline of {} points", zone.soil, model.soils.size(),
             zone.outline.size());
  if (model.water_table.empty()) return;
  std::vector<double> stations;
  for (const Vec2& p : model.ground) stations.push_back(p[0]);
  for (const Vec2& p : model.water_table)
    if (p[0] > model.ground.front()[0] && p[0] < model.ground.back()[0]) stations.push_back(p[0]);
  for (const double x : stations)
    validate(height_at(model.water_table, x) <= height_at(model.ground, x) + 0.05,
             "the water table stands {:.3g} m above the ground at x = {} m (free water would load "
             "the slope). Lower it to the ground there",
             height_at(model.water_table, x) - height_at(model.ground, x), x);
}

Column column_above(const SlopeModel& model, Vec2 point) {
  const auto [x, y] = point;
  const double top = height_at(model.ground, x);
  // Crossings of all outlines with the vertical through the point divide the column.
  std::vector<double> levels{y, top};
  for (const SlopeZone& zone : model.zones)
    for (std::size_t i = 0; i < zone.outline.size(); ++i) {
      const Vec2 a = zone.outline[i], b = zone.outline[(i + 1) % zone.outline.size()];
      if ((a[0] > x) == (b[0] > x)) continue;
      const double level = a[1] + (x - a[0]) / (b[0] - a[0]) * (b[1] - a[1]);
      if (level > y && level < top) levels.push_back(level);
    }
  std::sort(levels.begin(), levels.end());
  Column column;
  const SlopeSoil* base = nullptr;
  column.inside = top > y;
  for (std::size_t i = 1; i < levels.size(); ++i) {
    if (levels[i] - levels[i - 1] < 1e-9) continue;
    const Vec2 middle{x, 0.5 * (levels[i] + levels[i - 1])};
    const SlopeSoil* soil = nullptr;
    for (const SlopeZone& zone : model.zones)
      if (inside_outline(zone.outline, middle)) soil = &model.soils[zone.soil];
    if (!soil) {
      column.inside = false;
      continue;
    }
    if (!base) base = soil;
    column.weight += soil->unit_weight * (levels[i] - levels[i - 1]);
  }
  if (!base) {
    column.inside = false;
    return column;
  }
  if (base->r_u)
    column.pore_pressure = *base->r_u * column.weight;
  else if (!model.water_table.empty())
    column.pore_pressure =
        model.unit_weight_water * std::max(0.0, height_at(model.water_table, x) - y);
  column.cohesion = base->residual.empty()
                        ? base->cohesion
                        : interpolate(base->residual, column.weight - column.pore_pressure);
  column.tan_friction = base->residual.empty() ? tan(base->friction) : 0.0;
  return column;
}

}  // namespace flowslide
