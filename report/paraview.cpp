#include "report/paraview.hpp"

#include "core/check.hpp"
#include "core/files.hpp"
#include "model/vtk_writer.hpp"

#include <array>

namespace flowslide {
namespace {

using TimedFiles = std::vector<std::pair<double, std::filesystem::path>>;

void write_flow(const std::filesystem::path& out, const MpmHistory& flow,
                const Progress& progress) {
  const std::filesystem::path folder = out / "flow";
  make_folders(folder);
  TimedFiles series;
  for (std::size_t k = 0; k < flow.num_frames(); ++k) {
    if (progress.should_stop())
      throw Interrupted("interrupted while files for ParaView were written");
    const MpmFrame frame = flow.frame(k);
    const std::filesystem::path file = folder / fmt::format("frame_{:04}.vtp", k);
    write_vtp(file, flow.initial(), frame);
    series.emplace_back(frame.time, file);
  }
  write_pvd(out / "flow.pvd", series);
}

void write_zone(const std::filesystem::path& out, const FemHistory& history,
                const LiquefactionZone& zone) {
  validate(zone.transfer_frame < static_cast<int>(history.times().size()),
           "the zone was transferred at frame {}, the history has {} (they belong to different "
           "runs) give the report the files of one run",
           zone.transfer_frame, history.times().size());
  const FemFrame frame =
      zone.transfer_frame < 0 ? history.gravity() : history.frame(zone.transfer_frame);
  const QuadMesh& mesh = history.mesh();
  const std::vector<double> liquefied(zone.liquefied.begin(), zone.liquefied.end());
  const std::vector<double> layer(zone.layer.begin(), zone.layer.end());
  const std::vector<double> material(mesh.element_material.begin(), mesh.element_material.end());
  const std::array nodal{VtkField{.name = "r_u [-]", .values = zone.r_u_node}};
  const std::array elemental{VtkField{.name = "r_u [-]", .values = zone.r_u_element},
                             VtkField{.name = "liquefied", .values = liquefied},
                             VtkField{.name = "strength layer", .values = layer},
                             VtkField{.name = "strength [Pa]", .values = zone.strength},
                             VtkField{.name = "sigma_v0 [Pa]", .values = zone.sigma_v0},
                             VtkField{.name = "material", .values = material}};
  write_vtu(out / "zone.vtu", mesh, frame, nodal, elemental);
  write_pvd(out / "zone.pvd", TimedFiles{{zone.transfer_time, out / "zone.vtu"}});
}

}  // namespace

void write_paraview(const std::filesystem::path& out, const FemHistory& history,
                    const LiquefactionZone& zone, const MpmHistory& flow,
                    const Progress& progress) {
  write_flow(out, flow, progress);
  write_zone(out, history, zone);
}

}  // namespace flowslide
