#include "model/vtk_writer.hpp"

#include "core/check.hpp"
#include "core/files.hpp"
#include "core/xml_text.hpp"
#include "model/vtk_data.hpp"

#include <array>

#include <fmt/format.h>

namespace flowslide {
namespace {

using Arrays = std::vector<VtkArray>;

template <class T>
void add_flat(Arrays& to, std::string_view name, const T* values, std::size_t tuples,
              int components) {
  const std::size_t count = tuples * static_cast<std::size_t>(components);
  to.push_back({std::string(name), components, std::vector<T>(values, values + count)});
}

void add(Arrays& to, const std::string& name, const std::vector<double>& values) {
  add_flat(to, name, values.data(), values.size(), 1);
}

template <std::size_t N>
void add(Arrays& to, const std::string& name, const std::vector<std::array<double, N>>& values) {
  const double* first = values.empty() ? nullptr : values.front().data();
  add_flat(to, name, first, values.size(), static_cast<int>(N));
}

/// Vectors of the plane get a third component, without which ParaView does not treat them as such.
void add(Arrays& to, const std::string& name, const std::vector<Vec2>& values) {
  std::vector<std::array<double, 3>> spatial;
  for (const Vec2& v : values) spatial.push_back({v[0], v[1], 0.0});
  add(to, name, spatial);
}

void add(Arrays& to, std::span<const VtkField> fields, std::size_t tuples) {
  for (const VtkField& f : fields) {
    validate(
        f.components >= 1 && f.values.size() == tuples * static_cast<std::size_t>(f.components),
        "picture field '{}' has {} values ({} times {} are needed)", f.name, f.values.size(),
        tuples, f.components);
    add_flat(to, f.name, f.values.data(), tuples, f.components);
  }
}

template <std::size_t N>
std::vector<double> points(const std::vector<std::array<double, N>>& positions) {
  std::vector<double> result;
  for (const auto& x : positions)
    result.insert(result.end(), {x[0], x[1], N == 3 ? x[N - 1] : 0.0});
  return result;
}

/// One vertex per particle, without which ParaView shows nothing, and the materials by name.
VtkData particles(const std::vector<std::array<double, 3>>& position, const ParticleSet& p) {
  VtkData data;
  data.kind = VtkData::Kind::vertices;
  data.points = points(position);
  for (std::size_t i = 0; i < position.size(); ++i)
    data.cells.push_back(static_cast<std::int64_t>(i));
  add_flat(data.at_points, "material", p.material.data(), p.size(), 1);
  add_flat(data.at_points, "id", p.id.data(), p.size(), 1);
  std::vector<std::string> names;
  for (const MaterialSpec& m : p.materials) names.push_back(m.name);
  data.texts.emplace_back("material names", std::move(names));
  return data;
}

void write(const std::filesystem::path& path, const VtkData& data) {
#if FLOWSLIDE_VTK
  write_file(path, vtk_xml_of_library(data));
#else
  write_file(path, vtk_xml(data));
#endif
}

std::string labelled(std::string_view name, std::string_view unit) {
  std::string text(name);
  for (char& c : text)
    if (c == '_') c = ' ';
  return unit.empty() ? text : fmt::format("{} [{}]", text, unit);
}

}  // namespace

void write_vtp(const std::filesystem::path& path, const ParticleSet& p,
               std::span<const VtkField> extra) {
  VtkData data = particles(p.position, p);
  Arrays& to = data.at_points;
  visit_fields(p, [&to](std::string_view name, std::string_view unit, const auto& array) {
    using T = typename std::decay_t<decltype(array)>::value_type;
    // particles() has written the two whole-number fields; the position is that of the points.
    if constexpr (!std::is_integral_v<T>)
      if (name != "position") add(to, labelled(name, unit), array);
  });
  for (const auto& [name, values] : p.history) add(to, labelled(name, ""), values);
  add(to, extra, p.size());
  write(path, data);
}

void write_vtp(const std::filesystem::path& path, const ParticleSet& initial, const MpmFrame& frame,
               std::span<const VtkField> extra) {
  const std::size_t n = initial.size();
  validate(frame.position.size() == n && frame.velocity.size() == n && frame.stress.size() == n &&
               frame.volume.size() == n && frame.plastic_strain.size() == n &&
               frame.strength.size() == n,
           "the frame at t = {} s does not belong to these {} particles", frame.time, n);
  std::vector<std::array<double, 3>> displacement(n);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t c = 0; c < 3; ++c)
      displacement[i][c] =
          initial.displacement[i][c] + (frame.position[i][c] - initial.position[i][c]);
  VtkData data = particles(frame.position, initial);
  Arrays& to = data.at_points;
  add(to, "displacement [m]", displacement);
  add(to, "velocity [m/s]", frame.velocity);
  add(to, "stress [Pa]", frame.stress);
  add(to, "volume [m3]", frame.volume);
  add(to, "plastic strain [-]", frame.plastic_strain);
  add(to, "strength [Pa]", frame.strength);
  add(to, extra, n);
  write(path, data);
}

void write_vtu(const std::filesystem::path& path, const QuadMesh& mesh, const FemFrame& frame,
               std::span<const VtkField> nodal, std::span<const VtkField> elemental) {
  validate(
      frame.displacement.size() == mesh.num_nodes() && frame.velocity.size() == mesh.num_nodes() &&
          frame.pore_pressure.size() == mesh.num_nodes() &&
          frame.stress.size() == mesh.num_elements() && frame.strain.size() == mesh.num_elements(),
      "the frame at t = {} s does not belong to this mesh of {} nodes", frame.time,
      mesh.num_nodes());
  VtkData data;
  data.kind = VtkData::Kind::quads;
  data.points = points(mesh.nodes);
  for (const std::array<std::int32_t, 4>& n : mesh.elements)
    data.cells.insert(data.cells.end(), n.begin(), n.end());
  Arrays& nodes = data.at_points;
  add_flat(nodes, "node tag", mesh.node_tags.data(), mesh.num_nodes(), 1);
  add(nodes, "displacement [m]", frame.displacement);
  add(nodes, "velocity [m/s]", frame.velocity);
  add(nodes, "pore pressure [Pa]", frame.pore_pressure);
  add(nodes, nodal, mesh.num_nodes());
  Arrays& elements = data.at_cells;
  const std::size_t count = mesh.num_elements();
  add_flat(elements, "element tag", mesh.element_tags.data(), count, 1);
  add_flat(elements, "material", mesh.element_material.data(), count, 1);
  add_flat(elements, "effective stress [Pa]", frame.stress[0].v.data(), count, 4);
  add_flat(elements, "strain [-]", frame.strain[0].v.data(), count, 4);
  add(elements, elemental, count);
  write(path, data);
}

void write_pvd(const std::filesystem::path& path,
               std::span<const std::pair<double, std::filesystem::path>> files) {
  std::string text =
      "<?xml version=\"1.0\"?>\n"
      "<VTKFile type=\"Collection\" version=\"0.1\" byte_order=\"LittleEndian\">\n"
      "  <Collection>\n";
  const std::filesystem::path folder = std::filesystem::absolute(path).parent_path();
  for (const auto& [time, file] : files) {
    const std::string name =
        xml_text(std::filesystem::absolute(file).lexically_relative(folder).generic_string());
    text += fmt::format("    <DataSet timestep=\"{}\" part=\"0\" file=\"{}\"/>\n", time, name);
  }
  write_file(path, text + "  </Collection>\n</VTKFile>\n");
}

}  // namespace flowslide
