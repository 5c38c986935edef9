#include "exchange/convert.hpp"

#include "config/yaml.hpp"
#include "core/check.hpp"
#include "core/files.hpp"
#include "exchange/is_hdf5.hpp"
#include "exchange/is_terrain.hpp"
#include "exporters/cbgeo_csv.hpp"
#include "exporters/opensees_recorders.hpp"
#include "importers/mesh_import.hpp"
#include "model/field_store.hpp"
#include "model/history.hpp"
#include "model/motion_file.hpp"
#include "model/mpm_history.hpp"
#include "model/particle_set.hpp"
#include "model/section_mesh.hpp"
#include "model/vtk_writer.hpp"
#include "model/zone.hpp"
#include "motion/write_motion.hpp"
#include "report/tables.hpp"
#include "section/boundary.hpp"

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include <fmt/format.h>

namespace fs = std::filesystem;

namespace flowslide {
namespace {

/// A pair of formats; notes on what was lost go to the terminal.
struct Conversion {
  std::string from, to;  ///< kinds, as kind_of() and target_of() name them
  std::string in, out;   ///< in words
  std::function<Converted(const ConvertOptions&)> run;
};

/// Pictures NAME/NAME_0001.vtp beside NAME.pvd.
template <class Write>
void write_series(const fs::path& pvd, const std::vector<double>& times, const char* extension,
                  Write&& write) {
  const std::string stem = pvd.stem().string();
  const fs::path folder = pvd.parent_path() / stem;
  make_folders(folder);
  std::vector<std::pair<double, fs::path>> files;
  for (std::size_t i = 0; i < times.size(); ++i) {
    const fs::path file = folder / fmt::format("{}_{:04d}{}", stem, i, extension);
    write(i, file);
    files.emplace_back(times[i], file);
  }
  write_pvd(pvd, files);
}

Converted flow_to_pvd(const ConvertOptions& o) {
  const MpmHistory history(o.in);
  std::vector<double> times;
  for (std::size_t i = 0; i < history.num_frames(); ++i) times.push_back(history.frame(i).time);
  write_series(o.out, times, ".vtp", [&](std::size_t i, const fs::path& file) {
    write_vtp(file, history.initial(), history.frame(i));
  });
  return {};
}

Converted flow_to_vtp(const ConvertOptions& o) {
  const MpmHistory history(o.in);
  validate(history.num_frames() > 0, "{}: the history has no frames (nothing to show)", o.in);
  write_vtp(o.out, history.initial(), history.frame(history.num_frames() - 1));
  return {};
}

Converted shaking_to_pvd(const ConvertOptions& o) {
  const FemHistory history(o.in);
  std::vector<double> times = history.times();
  if (times.empty()) times = {history.gravity().time};
  write_series(o.out, times, ".vtu", [&](std::size_t i, const fs::path& file) {
    write_vtu(file, history.mesh(), history.times().empty() ? history.gravity() : history.frame(i));
  });
  return {};
}

Converted shaking_to_recorders(const ConvertOptions& o) {
  return {.notes = write_opensees_recorders(o.out, FemHistory(o.in))};
}

Converted mesh_to_vtu(const ConvertOptions& o) {
  const QuadMesh mesh = read_section_mesh(o.in).mesh;
  FemFrame rest;
  rest.displacement.resize(mesh.num_nodes());
  rest.velocity.resize(mesh.num_nodes());
  rest.pore_pressure.resize(mesh.num_nodes());
  rest.stress.resize(mesh.num_elements());
  rest.strain.resize(mesh.num_elements());
  const std::vector<double> material(mesh.element_material.begin(), mesh.element_material.end());
  const std::vector<VtkField> fields{{"material", material}};
  write_vtu(o.out, mesh, rest, {}, fields);
  return {};
}

Converted mesh_to_tables(const ConvertOptions& o) {
  const SectionMesh section = read_section_mesh(o.in);
  write_mesh_tables(o.out, section.mesh);
  return {
      .notes = {"the names of materials and the edge sets are left out; the tables have no place "
                "for them"}};
}

Converted write_mesh_of(const MeshImportConfig& config, const ConvertOptions& o) {
  SectionMesh section = import_mesh(config);
  add_outer_sets(section);
  write_section_mesh(o.out, section);
  return {.notes = section.notes};
}

Converted tables_to_mesh(const ConvertOptions& o) {
  MeshImportConfig config;
  config.tables.emplace();
  config.tables->nodes = {fs::path(o.in) / "nodeinfo.dat"};
  config.tables->elements = {fs::path(o.in) / "elementinfo.dat"};
  return write_mesh_of(config, o);
}

Converted gmsh_to_mesh(const ConvertOptions& o) {
  MeshImportConfig config;
  config.gmsh = InputFile{o.in};
  return write_mesh_of(config, o);
}

/// A record read and given to `write`, with what the reader had to say.
template <class Write>
Converted convert_record(const ConvertOptions& o, Write&& write) {
  const Record record = read_record(o.in, o.format);
  write(record.motion);
  return {record.notes, record.warnings};
}

const std::vector<Conversion>& conversions() {
  static const std::vector<Conversion> list = {
      {"particles", ".csv", "particles.h5", "NAME.csv, particles of CB-Geo MPM",
       [](const ConvertOptions& o) {
         write_cbgeo_csv(o.out, read_particles(o.in));
         return Converted{};
       }},
      {"particles", ".vtp", "particles.h5", "NAME.vtp for ParaView",
       [](const ConvertOptions& o) {
         write_vtp(o.out, read_particles(o.in));
         return Converted{};
       }},
      {"mpm_history", ".pvd", "mpm.h5", "NAME.pvd and NAME/*.vtp for ParaView", flow_to_pvd},
      {"mpm_history", ".vtp", "mpm.h5", "NAME.vtp, the last frame", flow_to_vtp},
      {"fem_history", ".pvd", "history.h5", "NAME.pvd and NAME/*.vtu for ParaView", shaking_to_pvd},
      {"fem_history", "folder", "history.h5", "FOLDER/ with OpenSees text recorders",
       shaking_to_recorders},
      {"zone", ".csv", "zone.h5", "NAME.csv, depths, energies and distortion over time",
       [](const ConvertOptions& o) {
         write_file(o.out, zone_csv(read_zone(o.in).history));
         return Converted{};
       }},
      {"mesh", ".vtu", "mesh.h5", "NAME.vtu for ParaView", mesh_to_vtu},
      {"mesh", "folder", "mesh.h5", "FOLDER/ with nodeinfo.dat and elementinfo.dat",
       mesh_to_tables},
      {"folder", ".h5", "folder with nodeinfo.dat and elementinfo.dat", "NAME.h5, a mesh",
       tables_to_mesh},
      {".msh", ".h5", "NAME.msh of gmsh", "NAME.h5, a mesh", gmsh_to_mesh},
      {"record", ".csv", "earthquake record (AT2, columns)", "NAME.csv, time and acceleration",
       [](const ConvertOptions& o) {
         return convert_record(o, [&](const GroundMotion& m) { write_motion(o.out, m); });
       }},
      {"record", ".h5", "earthquake record (AT2, columns)", "NAME.h5, a motion",
       [](const ConvertOptions& o) {
         return convert_record(o, [&](const GroundMotion& m) { write_motion_file(o.out, m); });
       }},
      {"motion", ".csv", "motion.h5", "NAME.csv, time and acceleration",
       [](const ConvertOptions& o) {
         write_motion(o.out, read_motion_file(o.in));
         return Converted{};
       }},
  };
  return list;
}

std::string kind_of(const fs::path& in) {
  if (type_of(in) == fs::file_type::directory) return "folder";
  if (is_hdf5(in)) return stored_kind(in);
  if (in.extension() == ".h5")
    throw FileError(fmt::format(
        "{}: does not begin as an HDF5 file (it is damaged, or of another kind) make it again",
        in.string()));
  if (in.extension() == ".msh") return ".msh";
  if (in.extension() == ".yaml" || in.extension() == ".yml") return "workflow";
  return is_terrain(in) ? "terrain" : "record";
}

std::string target_of(const std::string& out) {
  const fs::path path(out);
  if (out.ends_with('/') || type_of(path) == fs::file_type::directory || path.extension().empty())
    return "folder";
  return path.extension().string();
}

}  // namespace

std::string known_conversions() {
  std::string text;
  for (const Conversion& c : conversions()) text += fmt::format("\n  {} -> {}", c.in, c.out);
  return text;
}

Converted convert(const ConvertOptions& options) {
  const std::string from = kind_of(options.in), to = target_of(options.out);
  for (const Conversion& c : conversions()) {
    if (c.from != from || c.to != to) continue;
    std::error_code ignored;
    validate(!fs::equivalent(options.in, options.out, ignored),
             "{}: input and output are the same file (it would be lost)", options.in);
    return c.run(options);
  }
  throw InputError(
      fmt::format("{} is of kind '{}', and there is no conversion of that into '{}' "
                  "(the output is chosen by its ending). Known are:{}",
                  options.in, from, to, known_conversions()));
}

}  // namespace flowslide
