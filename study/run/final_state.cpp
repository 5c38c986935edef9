#include "study/run/final_state.hpp"

#include "model/field_store.hpp"
#include "model/mpm_history.hpp"

#include <cmath>

namespace flowslide::study {
namespace {

using Millimetres = std::vector<std::array<std::int32_t, 3>>;

Millimetres rounded(const std::vector<std::array<double, 3>>& metres) {
  Millimetres result;
  for (const auto& p : metres) {
    auto& mm = result.emplace_back();
    for (std::size_t d = 0; d < 3; ++d) mm[d] = static_cast<std::int32_t>(std::lround(p[d] * 1e3));
  }
  return result;
}

}  // namespace

void write_final_state(const std::filesystem::path& mpm_history, const std::filesystem::path& to) {
  const MpmHistory flow(mpm_history);
  const ParticleSet& points = flow.initial();
  const MpmFrame last = flow.frame(flow.num_frames() - 1);
  std::vector<std::array<double, 3>> before = points.position;
  for (std::size_t i = 0; i < before.size(); ++i)
    for (std::size_t d = 0; d < 3; ++d) before[i][d] -= points.displacement[i][d];
  std::vector<std::string> materials;
  for (const MaterialSpec& m : points.materials) materials.push_back(m.name);
  std::vector<std::vector<double>> series;
  for (const MpmSample& s : flow.samples())
    series.push_back({s.time, s.runout, s.front, s.max_speed, s.kinetic});

  FieldWriter writer(to, "mpm_final", 1);
  writer.write("position_before", rounded(before), {"mm", "x y z, of the undeformed section"});
  writer.write("position_after", rounded(last.position), {"mm", "x y z, at the end"});
  writer.write("material", points.material, {"", "index into materials"});
  writer.write("strength", last.strength, {"Pa", "at the end", Nan::allowed});
  writer.write_texts("materials", materials);
  writer.write_table("series", series, 5,
                     {"", "time [s], runout [m], front [m], largest speed [m/s], kinetic energy [J]"});
  writer.finish();
}

}  // namespace flowslide::study
