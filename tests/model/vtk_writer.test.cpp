#include "model/vtk_writer.hpp"

#include "core/check.hpp"
#include "tests/model/scratch.hpp"

#include <catch2/catch.hpp>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkStringArray.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLPolyDataReader.h>
#include <vtkXMLUnstructuredGridReader.h>

using namespace flowslide;
using Catch::Matchers::Contains;

namespace {

ParticleSet two_particles() {
  ParticleSet p;
  p.history["r_u"] = {};
  resize(p, 2);
  p.materials = {{"dam", "mohr_coulomb", {}, true}, {"tailings \xc3\xa4", "tresca", {}, true}};
  p.position = {{1.0 / 3.0, 2.0, 0.0}, {1e5 + 1e-9, 0.0, 0.0}};
  p.displacement = {{0.5, 0.0, 0.0}, {0.0, 0.0, 0.0}};
  p.stress[1] = {1, 2, 3, 4, 5, 6};
  p.mass = {1.0, 2.0};
  p.volume = {1.0, 2.0};
  p.material = {1, 0};
  p.id = {5, 10000000000};
  p.history["r_u"] = {0.25, 0.75};
  return p;
}

}  // namespace

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

TEST_CASE("a series names its files relative to itself, with their times") {
  const Scratch folder;
  const std::vector<std::pair<double, std::filesystem::path>> files{
      {0.0, folder / "frames/a.vtp"}, {0.1, folder / "frames/b&c.vtp"}};
  write_pvd(folder / "run.pvd", files);
  const std::string text = bytes_of(folder / "run.pvd");
  CHECK_THAT(text, Contains("timestep=\"0.1\" part=\"0\" file=\"frames/b&amp;c.vtp\""));
  CHECK_THAT(text, Contains("file=\"frames/a.vtp\""));
  CHECK_THROWS_AS(write_pvd(folder / "no/run.pvd", files), FileError);
}

TEST_CASE("equal particles give equal pictures, and a bad place an error") {
  const Scratch folder;
  write_vtp(folder / "a.vtp", two_particles());
  write_vtp(folder / "b.vtp", two_particles());
  CHECK(bytes_of(folder / "a.vtp") == bytes_of(folder / "b.vtp"));
  CHECK_THROWS_AS(write_vtp(folder / "no/a.vtp", two_particles()), FileError);
}
