#include "workflows/stages/section_view.hpp"

#include "workflows/stages/preview.hpp"

#include <map>

#include <fmt/format.h>

namespace flowslide {
namespace {

std::vector<Vec2> points_of(const std::vector<std::vector<double>>& rows) {
  std::vector<Vec2> line;
  for (const std::vector<double>& row : rows) line.push_back({row[0], row[1]});
  return line;
}

/// Soils by tag; those of an import may have no name.
std::vector<PlottedSoil> soils_of(const SectionMesh& section) {
  std::map<int, std::string> names;
  for (const std::int32_t tag : section.mesh.element_material)
    names.try_emplace(tag, fmt::format("material {}", tag));
  for (const MaterialName& m : section.materials) names[m.tag] = m.name;
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
  plot.soils = soils_of(*known.section);
  if (known.zone)
    for (const auto& [name, window] : known.zone->windows)
      plot.windows.push_back({name, window.from, window.to});
  if (known.water) plot.water = points_of(known.water->table);
  if (known.map && !known.map->box.empty()) {
    const std::vector<double>& b = known.map->box;
    plot.box = {b[0], b[1], b[2], b[3]};
  }
  if (known.flow) {
    plot.ground = points_of(known.flow->ground.surface);
    plot.toe = known.flow->toe;
  }
  return view;
}

}  // namespace flowslide
