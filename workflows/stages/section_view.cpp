#include "workflows/stages/section_view.hpp"

#include "workflows/stages/cross_checks.hpp"
#include "workflows/stages/preview.hpp"

#include <algorithm>
#include <map>

#include <fmt/format.h>

namespace flowslide {
namespace {

std::vector<Vec2> points_of(const std::vector<std::vector<double>>& rows) {
  std::vector<Vec2> line;
  for (const std::vector<double>& row : rows) line.push_back({row[0], row[1]});
  return line;
}

/// Open sides end with the section; nothing where all are open.
std::optional<std::array<double, 4>> drawn_box(const SectionBox& box, const QuadMesh& mesh) {
  if (!box.left && !box.right && !box.bottom && !box.top) return std::nullopt;
  const Extent e = extent_of(mesh);
  return std::array{box.left.value_or(e.left), box.right.value_or(e.right),
                    box.bottom.value_or(e.bottom), box.top.value_or(e.top)};
}

/// Soils by tag.
std::vector<PlottedSoil> soils_of(const SectionMesh& section,
                                  const std::vector<HistoryMaterial>& materials) {
  std::map<int, std::string> names;
  for (const std::int32_t tag : section.mesh.element_material)
    names.try_emplace(tag, fmt::format("material {}", tag));
  for (const MaterialName& m : section.materials) names[m.tag] = m.name;
  for (const HistoryMaterial& m : materials) names[m.tag] = m.name;
  std::vector<PlottedSoil> soils;
  for (const auto& [tag, name] : names) soils.push_back({tag, name});
  return soils;
}

}  // namespace

SectionView view_section(const Workflow& workflow) {
  Previews all;
  for (const WorkflowStage& stage : workflow.stages) all[stage.name] = stage.preview;
  const Preview known = merged(all);
  SectionView view{known.section, {}};
  if (!known.section) return view;
  WorkflowPlot& plot = view.plot;
  plot.title = workflow.name;
  plot.soils = soils_of(*known.section, known.materials);
  if (known.zone)
    for (const auto& [name, window] : known.zone->windows)
      plot.windows.push_back({name, window.from, window.to});
  if (known.water) plot.water = points_of(known.water->table);
  if (known.map) plot.box = drawn_box(known.map->box, known.section->mesh);
  if (known.flow) plot.ground = points_of(known.flow->ground.surface);
  plot.toe = known.toe;
  if (!plot.toe && known.map && !known.materials.empty()) {
    const Soil soil = soil_of(*known.section, *known.map, known.materials);
    if (!soil.counted.empty()) plot.toe = soil.counted.right;
  }
  return view;
}

}  // namespace flowslide
