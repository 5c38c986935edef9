#include "model/vtk_writer.hpp"

#include "core/check.hpp"
#include "core/files.hpp"

#include <array>
#include <new>

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkStringArray.h>
#include <vtkTypeInt64Array.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLPolyDataWriter.h>
#include <vtkXMLUnstructuredGridWriter.h>

namespace flowslide {
namespace {

/// ParaView names the components after these.
constexpr std::array<const char*, 6> kTensor{"XX", "YY", "ZZ", "XY", "YZ", "ZX"};

template <class Array, class T>
void add_flat(vtkFieldData* to, const std::string& name, const T* values, std::size_t tuples,
              int components) {
  vtkNew<Array> array;
  array->SetName(name.c_str());
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(static_cast<vtkIdType>(tuples));
  const std::size_t count = tuples * static_cast<std::size_t>(components);
  std::copy(values, values + count, array->GetPointer(0));
  if (components == 4 || components == 6)
    for (int c = 0; c < components; ++c) array->SetComponentName(c, kTensor[c]);
  to->AddArray(array);
}

void add(vtkFieldData* to, const std::string& name, const std::vector<double>& values) {
  add_flat<vtkDoubleArray>(to, name, values.data(), values.size(), 1);
}

template <std::size_t N>
void add(vtkFieldData* to, const std::string& name,
         const std::vector<std::array<double, N>>& values) {
  const double* first = values.empty() ? nullptr : values.front().data();
  add_flat<vtkDoubleArray>(to, name, first, values.size(), static_cast<int>(N));
}

/// Vectors of the plane get a third component, without which ParaView does not treat them as such.
void add(vtkFieldData* to, const std::string& name, const std::vector<Vec2>& values) {
  std::vector<std::array<double, 3>> spatial;
  for (const Vec2& v : values) spatial.push_back({v[0], v[1], 0.0});
  add(to, name, spatial);
}

void add(vtkFieldData* to, std::span<const VtkField> fields, std::size_t tuples) {
  for (const VtkField& f : fields) {
    validate(
        f.components >= 1 && f.values.size() == tuples * static_cast<std::size_t>(f.components),
        "picture field '{}' has {} values ({} times {} are needed)", f.name, f.values.size(),
        tuples, f.components);
    add_flat<vtkDoubleArray>(to, f.name, f.values.data(), tuples, f.components);
  }
}

template <std::size_t N>
vtkNew<vtkPoints> points(const std::vector<std::array<double, N>>& positions) {
  vtkNew<vtkPoints> result;
  result->SetDataTypeToDouble();
  result->SetNumberOfPoints(static_cast<vtkIdType>(positions.size()));
  for (std::size_t i = 0; i < positions.size(); ++i)
    result->SetPoint(static_cast<vtkIdType>(i), positions[i][0], positions[i][1],
                     N == 3 ? positions[i][N - 1] : 0.0);
  return result;
}

/// One vertex per particle, without which ParaView shows nothing, and the materials by name.
void add_particles(vtkPolyData* data, const std::vector<std::array<double, 3>>& position,
                   const ParticleSet& p) {
  data->SetPoints(points(position));
  vtkNew<vtkCellArray> vertices;
  for (std::size_t i = 0; i < position.size(); ++i)
    vertices->InsertNextCell({static_cast<vtkIdType>(i)});
  data->SetVerts(vertices);
  add_flat<vtkIntArray>(data->GetPointData(), "material", p.material.data(), p.size(), 1);
  add_flat<vtkTypeInt64Array>(data->GetPointData(), "id", p.id.data(), p.size(), 1);
  vtkNew<vtkStringArray> names;
  names->SetName("material names");
  for (const MaterialSpec& m : p.materials) names->InsertNextValue(m.name);
  data->GetFieldData()->AddArray(names);
}

/// Through memory: VTK does not look at the result of closing its files.
template <class Writer, class Data>
void write(const std::filesystem::path& path, Data* data) {
  // VTK would print its own account of a failure besides the exception's.
  vtkObject::GlobalWarningDisplayOff();
  vtkNew<Writer> writer;
  writer->WriteToOutputStringOn();
  writer->SetInputData(data);
  writer->SetDataModeToAppended();
  writer->EncodeAppendedDataOff();
  writer->SetCompressorTypeToZLib();
  if (writer->Write() != 1 || writer->GetErrorCode() != 0) throw std::bad_alloc();
  write_file(path, writer->GetOutputString());
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
  vtkNew<vtkPolyData> data;
  add_particles(data, p.position, p);
  vtkFieldData* to = data->GetPointData();
  visit_fields(p, [to](std::string_view name, std::string_view unit, const auto& array) {
    using T = typename std::decay_t<decltype(array)>::value_type;
    // add_particles has written the two whole-number fields; the position is that of the points.
    if constexpr (!std::is_integral_v<T>)
      if (name != "position") add(to, labelled(name, unit), array);
  });
  for (const auto& [name, values] : p.history) add(to, labelled(name, ""), values);
  add(to, extra, p.size());
  write<vtkXMLPolyDataWriter>(path, data.Get());
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
  vtkNew<vtkPolyData> data;
  add_particles(data, frame.position, initial);
  vtkFieldData* to = data->GetPointData();
  add(to, "displacement [m]", displacement);
  add(to, "velocity [m/s]", frame.velocity);
  add(to, "stress [Pa]", frame.stress);
  add(to, "volume [m3]", frame.volume);
  add(to, "plastic strain [-]", frame.plastic_strain);
  add(to, "strength [Pa]", frame.strength);
  add(to, extra, n);
  write<vtkXMLPolyDataWriter>(path, data.Get());
}

void write_vtu(const std::filesystem::path& path, const QuadMesh& mesh, const FemFrame& frame,
               std::span<const VtkField> nodal, std::span<const VtkField> elemental) {
  validate(
      frame.displacement.size() == mesh.num_nodes() && frame.velocity.size() == mesh.num_nodes() &&
          frame.pore_pressure.size() == mesh.num_nodes() &&
          frame.stress.size() == mesh.num_elements() && frame.strain.size() == mesh.num_elements(),
      "the frame at t = {} s does not belong to this mesh of {} nodes", frame.time,
      mesh.num_nodes());
  vtkNew<vtkUnstructuredGrid> data;
  data->SetPoints(points(mesh.nodes));
  vtkNew<vtkCellArray> quads;
  for (const std::array<std::int32_t, 4>& n : mesh.elements)
    quads->InsertNextCell({n[0], n[1], n[2], n[3]});
  data->SetCells(VTK_QUAD, quads);
  add_flat<vtkTypeInt64Array>(data->GetPointData(), "node tag", mesh.node_tags.data(),
                              mesh.num_nodes(), 1);
  add(data->GetPointData(), "displacement [m]", frame.displacement);
  add(data->GetPointData(), "velocity [m/s]", frame.velocity);
  add(data->GetPointData(), "pore pressure [Pa]", frame.pore_pressure);
  add(data->GetPointData(), nodal, mesh.num_nodes());
  add_flat<vtkTypeInt64Array>(data->GetCellData(), "element tag", mesh.element_tags.data(),
                              mesh.num_elements(), 1);
  add_flat<vtkIntArray>(data->GetCellData(), "material", mesh.element_material.data(),
                        mesh.num_elements(), 1);
  add_flat<vtkDoubleArray>(data->GetCellData(), "effective stress [Pa]", frame.stress[0].v.data(),
                           mesh.num_elements(), 4);
  add_flat<vtkDoubleArray>(data->GetCellData(), "strain [-]", frame.strain[0].v.data(),
                           mesh.num_elements(), 4);
  add(data->GetCellData(), elemental, mesh.num_elements());
  write<vtkXMLUnstructuredGridWriter>(path, data.Get());
}

void write_pvd(const std::filesystem::path& path,
               std::span<const std::pair<double, std::filesystem::path>> files) {
  std::string text =
      "<?xml version=\"1.0\"?>\n"
      "<VTKFile type=\"Collection\" version=\"0.1\" byte_order=\"LittleEndian\">\n"
      "  <Collection>\n";
  const std::filesystem::path folder = std::filesystem::absolute(path).parent_path();
  for (const auto& [time, file] : files) {
    std::string name;
    for (char c : std::filesystem::absolute(file).lexically_relative(folder).generic_string()) {
      if (c == '&')
        name += "&amp;";
      else if (c == '<')
        name += "&lt;";
      else if (c == '"')
        name += "&quot;";
      else
        name += c;
    }
    text += fmt::format("    <DataSet timestep=\"{}\" part=\"0\" file=\"{}\"/>\n", time, name);
  }
  write_file(path, text + "  </Collection>\n</VTKFile>\n");
}

}  // namespace flowslide
