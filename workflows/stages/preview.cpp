#include "workflows/stages/preview.hpp"

namespace flowslide {

Preview merged(const Previews& inputs) {
  Preview all;
  for (const auto& [port, value] : inputs) {
    const auto* p = std::any_cast<Preview>(&value);
    if (!p) continue;
    if (!all.motion_end) all.motion_end = p->motion_end;
    if (!all.mean_period) all.mean_period = p->mean_period;
    if (!all.top_frequency) all.top_frequency = p->top_frequency;
    if (!all.section) all.section = p->section;
    all.shakes = all.shakes || p->shakes;
    if (!all.end) all.end = p->end;
    if (all.materials.empty()) all.materials = p->materials;
    if (!all.water) all.water = p->water;
    if (!all.fem) all.fem = p->fem;
    if (!all.toe) all.toe = p->toe;
    if (!all.stop) all.stop = p->stop;
    if (!all.zone) all.zone = p->zone;
    if (!all.map) all.map = p->map;
    if (!all.flow) all.flow = p->flow;
  }
  return all;
}

}  // namespace flowslide
