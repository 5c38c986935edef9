#include "model/vtk_writer.hpp"

#include "core/check.hpp"
#include "model/vtk_data.hpp"
#include "tests/model/scratch.hpp"
#include "tests/model/two_particles.hpp"

#include <catch2/catch.hpp>
#include <fmt/format.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkStringArray.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLPolyDataReader.h>
#include <vtkXMLUnstructuredGridReader.h>

using namespace flowslide;
using Catch::Matchers::Contains;

TEST_CASE("particles for ParaView keep values, names and double precision") {
  const Scratch folder;
  const ParticleSet p = two_particles();
  const std::vector<double> depth{3.0, 4.0};
  write_vtp(folder / "p.vtp", p, std::vector<VtkField>{{"depth [m]", depth}});
  CHECK(folder.entries() == 1);
  vtkNew<vtkXMLPolyDataReader> in;
  in->SetFileName((folder / "p.vtp").c_str());
  in->Update();
  vtkPolyData* data = in->GetOutput();
  REQUIRE(data->GetNumberOfPoints() == 2);
  CHECK(data->GetNumberOfVerts() == 2);
  CHECK(data->GetPoint(0)[0] == 1.0 / 3.0);
  CHECK(data->GetPoint(1)[0] == 1e5 + 1e-9);
  vtkPointData* fields = data->GetPointData();
  for (const char* name :
       {"velocity [m/s]", "displacement [m]", "mass [kg]", "volume [m3]", "stress [Pa]",
        "pore pressure [Pa]", "material", "id", "r u", "depth [m]"}) {
    CAPTURE(name);
    CHECK(fields->HasArray(name));
  }
  CHECK(fields->GetArray("stress [Pa]")->GetComponent(1, 3) == 4.0);
  CHECK(std::string(fields->GetArray("stress [Pa]")->GetComponentName(3)) == "XY");
  CHECK(fields->GetArray("id")->GetComponent(1, 0) == 1e10);
  CHECK(fields->GetArray("depth [m]")->GetComponent(1, 0) == 4.0);
  auto* names =
      vtkStringArray::SafeDownCast(data->GetFieldData()->GetAbstractArray("material names"));
  REQUIRE(names);
  CHECK(names->GetValue(1) == "tailings \xc3\xa4");
}

TEST_CASE("a frame of the runout carries displacement from the undeformed section") {
  const Scratch folder;
  const ParticleSet p = two_particles();
  MpmFrame f;
  f.position = {{1.0 / 3.0 + 2.0, 2.0, 0.0}, {1e5, 0.0, 0.0}};
  f.velocity.resize(2);
  f.stress.resize(2);
  f.volume = {1, 1};
  f.plastic_strain = {0.1, 0.2};
  f.strength = {1e3, kUnset};
  write_vtp(folder / "f.vtp", p, f);
  vtkNew<vtkXMLPolyDataReader> in;
  in->SetFileName((folder / "f.vtp").c_str());
  in->Update();
  vtkPointData* fields = in->GetOutput()->GetPointData();
  CHECK(fields->GetArray("displacement [m]")->GetComponent(0, 0) == Approx(2.5));
  CHECK(fields->GetArray("strength [Pa]")->GetComponent(0, 0) == 1e3);
  CHECK(fields->GetArray("plastic strain [-]")->GetComponent(1, 0) == 0.2);
  f.volume.pop_back();
  CHECK_THROWS_AS(write_vtp(folder / "f.vtp", p, f), InputError);
}

TEST_CASE("a mesh for ParaView has its fields at nodes and elements") {
  const Scratch folder;
  QuadMesh m;
  m.nodes = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  m.node_tags = {1, 2, 3, 4};
  m.elements = {{0, 1, 2, 3}};
  m.element_tags = {9};
  m.element_material = {3};
  FemFrame f;
  f.displacement.assign(4, {0.1, 0.2});
  f.velocity.assign(4, {0, 0});
  f.pore_pressure = {1, 2, 3, 4};
  f.stress = {{{1, 2, 3, 4}}};
  f.strain.resize(1);
  const std::vector<double> r_u{0.9};
  write_vtu(folder / "m.vtu", m, f, {}, std::vector<VtkField>{{"r_u [-]", r_u}});
  vtkNew<vtkXMLUnstructuredGridReader> in;
  in->SetFileName((folder / "m.vtu").c_str());
  in->Update();
  vtkUnstructuredGrid* data = in->GetOutput();
  REQUIRE(data->GetNumberOfCells() == 1);
  CHECK(data->GetCellType(0) == VTK_QUAD);
  CHECK(data->GetPointData()->GetArray("displacement [m]")->GetComponent(3, 1) == 0.2);
  CHECK(data->GetPointData()->GetArray("pore pressure [Pa]")->GetComponent(2, 0) == 3.0);
  CHECK(data->GetCellData()->GetArray("effective stress [Pa]")->GetComponent(0, 3) == 4.0);
  CHECK(data->GetCellData()->GetArray("r_u [-]")->GetComponent(0, 0) == 0.9);
  CHECK_THROWS_WITH(write_vtu(folder / "m.vtu", m, f, std::vector<VtkField>{{"r_u [-]", r_u}}),
                    Contains("r_u [-]"));
}

namespace {

/// What VTK reads, array by array.
std::string told(vtkFieldData* data) {
  std::string text;
  for (int i = 0; i < data->GetNumberOfArrays(); ++i) {
    vtkAbstractArray* a = data->GetAbstractArray(i);
    text += std::string(a->GetName()) + " " + a->GetClassName();
    for (int c = 0; c < a->GetNumberOfComponents(); ++c)
      text += std::string(" ") + (a->GetComponentName(c) ? a->GetComponentName(c) : "-");
    for (vtkIdType k = 0; k < a->GetNumberOfValues(); ++k) {
      const double value = a->GetVariantValue(k).ToDouble();
      text += a->GetVariantValue(k).IsString() ? " " + a->GetVariantValue(k).ToString()
                                               : fmt::format(" {:a}", value);
    }
    text += "\n";
  }
  return text;
}

std::string told(vtkPointSet* data) {
  std::string text =
      fmt::format("{} points {} cells\n", data->GetNumberOfPoints(), data->GetNumberOfCells());
  for (vtkIdType i = 0; i < data->GetNumberOfPoints(); ++i)
    text += fmt::format("{:a} {:a} {:a}\n", data->GetPoint(i)[0], data->GetPoint(i)[1],
                        data->GetPoint(i)[2]);
  vtkNew<vtkIdList> cell;
  for (vtkIdType i = 0; i < data->GetNumberOfCells(); ++i) {
    data->GetCellPoints(i, cell);
    text += fmt::format("type {}:", data->GetCellType(i));
    for (vtkIdType k = 0; k < cell->GetNumberOfIds(); ++k)
      text += fmt::format(" {}", cell->GetId(k));
    text += "\n";
  }
  return text + told(data->GetPointData()) + "cells\n" + told(data->GetCellData()) + "texts\n" +
         told(data->GetFieldData());
}

template <class Reader>
std::string read_by_vtk(const std::string& file) {
  const Scratch folder;
  put_bytes(folder / "picture", file);
  vtkNew<Reader> reader;
  reader->SetFileName((folder / "picture").c_str());
  reader->Update();
  return told(static_cast<vtkPointSet*>(reader->GetOutput()));
}

}  // namespace

TEST_CASE("VTK reads the same from a file of its own and from one of the built-in writer") {
  // 4096 numbers of 8 bytes fill a block of the files; a NaN stands for "unset".
  const int points = GENERATE(0, 1, 4095, 4096, 4097);
  CAPTURE(points);
  VtkData data;
  std::vector<double> scalar, tensor;
  std::vector<std::int32_t> material;
  std::vector<std::int64_t> id;
  for (int i = 0; i < points; ++i) {
    data.points.insert(data.points.end(), {i / 3.0, 1e5 + 1e-9 * i, -0.5 * i});
    data.cells.push_back(i);
    scalar.push_back(i % 7 ? 1.0 / i : kUnset);
    for (int c = 0; c < 6; ++c) tensor.push_back(i * 0.1 + c);
    material.push_back(-i);
    id.push_back(10000000000 + i);
  }
  data.at_points = {{"strength [Pa]", 1, scalar},
                    {"stress [Pa]", 6, tensor},
                    {"material", 1, material},
                    {"id", 1, id}};
  data.texts = {{"material names", {"dam", "", "tailings \xc3\xa4"}}};
  CHECK(read_by_vtk<vtkXMLPolyDataReader>(vtk_xml(data)) ==
        read_by_vtk<vtkXMLPolyDataReader>(vtk_xml_of_library(data)));

  data.kind = VtkData::Kind::quads;
  data.cells.resize(data.cells.size() / 4 * 4);
  data.at_cells = {{"element tag", 1, std::vector<std::int64_t>(data.cells.size() / 4, 7)}};
  const std::string read = read_by_vtk<vtkXMLUnstructuredGridReader>(vtk_xml(data));
  CHECK(read == read_by_vtk<vtkXMLUnstructuredGridReader>(vtk_xml_of_library(data)));
  CHECK_THAT(read, Catch::StartsWith(fmt::format("{} points {} cells", points, points / 4)));

  // VTK's own writer makes no valid XML of such a name.
  data.at_cells[0].name = "a<b & \"c\"";
  CHECK_THAT(read_by_vtk<vtkXMLUnstructuredGridReader>(vtk_xml(data)), Contains("a<b & \"c\" vtk"));
}
