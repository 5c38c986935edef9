#include "tests/fuzz/good_files.hpp"

#include "model/hdf5_handle.hpp"
#include "model/history.hpp"
#include "model/motion_file.hpp"
#include "model/mpm_history.hpp"
#include "model/section_mesh.hpp"
#include "model/zone.hpp"
#include "tests/fuzz/input.hpp"
#include "tests/support/materials.hpp"

namespace flowslide::fuzz {
namespace {

SectionMesh two_squares() {
  SectionMesh s;
  s.mesh.nodes = {{0, 0}, {1, 0}, {2, 0}, {0, 1}, {1, 1}, {2, 1}};
  s.mesh.node_tags = {1, 2, 3, 4, 5, 6};
  s.mesh.elements = {{0, 1, 4, 3}, {1, 2, 5, 4}};
  s.mesh.element_tags = {10, 20};
  s.mesh.element_material = {168, 170};
  s.materials = {{"tailings", 168}, {"clay", 170}};
  s.sets = {{"base", {{0, 1}, {1, 2}}}, {"right", {{2, 5}}}};
  s.notes = {"a note"};
  return s;
}

FemFrame frame_at(double time) {
  FemFrame f;
  f.time = time;
  f.displacement.assign(6, {time, 0.0});
  f.velocity.assign(6, {kUnset, 1.0});
  f.pore_pressure.assign(6, 1e4);
  f.stress.assign(2, {{-1.0, -2.0, -1.5, 0.0}});
  f.strain.assign(2, {});
  return f;
}

void write_shaking(const std::filesystem::path& path) {
  FemHistoryWriter out(path, two_squares().mesh, test::materials_of(two_squares().mesh),
                       {"a test", "mean", {"a note"}});
  out.set_gravity(frame_at(0.0));
  for (const double time : {0.1, 0.2}) out.append(frame_at(time));
  out.finish();
}

LiquefactionZone zone() {
  LiquefactionZone z;
  z.transfer_reason = "a reason";
  z.r_u_node.assign(6, 0.5);
  z.r_u_element = {0.7, kUnset};
  z.sigma_v0 = {1e5, 2e3};
  z.liquefied = {1, 0};
  z.strength = {3e3, kUnset};
  z.layer = {0, -1};
  z.lower_boundary = {{0.0, 1.0}, {2.0, 0.5}};
  z.window_names = z.history.window_names = {"crest", "pond"};
  z.window_depth_max = z.window_depth_any = z.window_depth_interpolated = z.window_depth_strong =
      z.window_depth_before_slide = {1.0, 2.0};
  z.history.time = {0.0, 1.0};
  z.history.depth = z.history.depth_max = z.history.depth_any =
      z.history.depth_interpolated = {{0, 1}, {0, 2}};
  z.history.kinetic_energy = z.history.sliding_energy = z.history.kinetic_energy_relative = {0, 10};
  z.history.distortion_gauss = z.history.distortion_centre = {1, 0.9};
  z.notes = {"a note"};
  return z;
}

ParticleSet particles() {
  ParticleSet p;
  p.history["r_u"] = {};
  resize(p, 4);
  p.materials = {{"dam", "mohr_coulomb", {{"cohesion", 1e3}}, true}};
  p.mass.assign(4, 1.0);
  p.volume.assign(4, 1.0);
  p.id = {3, 1, 2, 0};
  p.notes = {"a note"};
  return p;
}

void write_runout(const std::filesystem::path& path) {
  MpmHistoryWriter out(path, particles(), {});
  for (const double time : {0.0, 0.5}) {
    MpmFrame f;
    f.time = time;
    f.position.resize(4);
    f.velocity.resize(4);
    f.stress.resize(4);
    f.volume.assign(4, 1.0);
    f.plastic_strain.assign(4, 0.0);
    f.strength.assign(4, kUnset);
    out.append(f);
    MpmSample s;
    s.time = time;
    out.append(s);
  }
  out.finish();
}

std::vector<std::string> datasets_of(const std::filesystem::path& path) {
  const Hdf5Handle opened(H5Fopen(path.c_str(), H5F_ACC_RDONLY, file_access()), &H5Fclose);
  std::vector<std::string> names;
  const auto add = [](hid_t, const char* name, const H5O_info_t* info, void* out) -> herr_t {
    if (info->type == H5O_TYPE_DATASET)
      static_cast<std::vector<std::string>*>(out)->emplace_back(name);
    return 0;
  };
  H5Ovisit(opened, H5_INDEX_NAME, H5_ITER_INC, add, &names);
  return names;
}

void read_shaking(const std::filesystem::path& path) {
  const FemHistory h(path);
  for (std::size_t i = 0; i < h.times().size(); ++i) (void)h.frame(i);
}
void read_runout(const std::filesystem::path& path) {
  const MpmHistory h(path);
  for (std::size_t i = 0; i < h.num_frames(); ++i) (void)h.frame(i);
}

}  // namespace

const std::vector<GoodFile>& good_files() {
  static const std::vector<GoodFile> files = [] {
    start_hdf5();
    std::vector<GoodFile> list;
    const auto add = [&](auto&& write, void (*read)(const std::filesystem::path&)) {
      const auto path = folder() / "good.h5";
      write(path);
      read(path);  // a control: it is good
      list.push_back({read_text_file(path), datasets_of(path), read});
    };
    using Path = std::filesystem::path;
    add([](const Path& p) { write_section_mesh(p, two_squares()); },
        [](const Path& p) { (void)read_section_mesh(p); });
    add(
        [](const Path& p) {
          write_motion_file(p, {0.01, {0.0, 1.0, -1.0}, "a test"});
        },
        [](const Path& p) { (void)read_motion_file(p); });
    add(write_shaking, read_shaking);
    add([](const Path& p) { write_zone(p, zone()); }, [](const Path& p) { (void)read_zone(p); });
    add([](const Path& p) { write_particles(p, particles()); },
        [](const Path& p) { (void)read_particles(p); });
    add(write_runout, read_runout);
    return list;
  }();
  return files;
}

}  // namespace flowslide::fuzz
