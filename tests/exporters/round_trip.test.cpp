#include "exporters/opensees_recorders.hpp"
#include "importers/opensees.hpp"
#include "tests/model/scratch.hpp"
#include "tests/support/materials.hpp"

#include <algorithm>
#include <cmath>

#include <catch2/catch.hpp>

using namespace flowslide;

namespace {

OpenSeesConfig standard_names(const std::filesystem::path& folder) {
  OpenSeesConfig c;
  c.mesh.nodes = {folder / "nodeinfo.dat"};
  c.mesh.elements = {folder / "elementinfo.dat"};
  c.materials = {{"tailings", {168, 1870.0, {}}}};
  c.units = {"m", "s", "kPa"};
  c.gravity.stress = {folder / "Gstress.out"};
  c.gravity.strain = InputFile{folder / "Gstrain.out"};
  c.gravity.pore_pressure = {folder / "GporePressure.out"};
  c.shaking.emplace();
  c.shaking->displacement = {folder / "displacement.out"};
  c.shaking->velocity = {folder / "velocity.out"};
  c.shaking->pore_pressure = {folder / "porePressure.out"};
  c.shaking->stress = {folder / "stress.out"};
  c.shaking->strain = {folder / "strain.out"};
  return c;
}

/// Two rows of cells under a uniform weight, shaking with irregular numbers.
void write_history(const std::filesystem::path& path) {
  QuadMesh mesh;
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 3; ++j) {
      mesh.nodes.push_back({1.0 / 3.0 * i, 2.0 * j});
      mesh.node_tags.push_back(100 + 3 * i + j);
    }
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 2; ++j) {
      const int n = 3 * i + j;
      mesh.elements.push_back({n, n + 3, n + 4, n + 1});
      mesh.element_tags.push_back(2 * i + j + 1);
      mesh.element_material.push_back(168);
    }
  const auto frame = [&](double time) {
    FemFrame f;
    f.time = time;
    for (std::size_t i = 0; i < mesh.num_nodes(); ++i) {
      const double x = std::sin(7.0 * time + static_cast<double>(i));
      f.displacement.push_back({0.01 * x, 1e-5 * x * x});
      f.velocity.push_back({0.1 * x, -0.02 * x});
      f.pore_pressure.push_back(9810.0 * (4.0 - mesh.nodes[i][1]) + 100.0 * time * x);
    }
    for (std::size_t e = 0; e < mesh.num_elements(); ++e) {
      const double y = centroid(corners(mesh, mesh.nodes, e))[1];
      const double x = time * std::cos(static_cast<double>(e));
      const double yy = -9e3 * (4.0 - y) + x, xx = 0.5 * yy;
      f.stress.push_back(Stress<2>{{xx, yy, 0.5 * (xx + yy), x / 3.0}});
      f.strain.push_back(StrainIncrement<2>{{1e-6 * x, -1e-5 * x, 0.0, 1e-4 * x}});
    }
    return f;
  };
  FemHistoryWriter writer(path, mesh, test::materials_of(mesh), {});
  writer.set_gravity(frame(0.0));
  for (const double t : {0.1, 0.2, 0.3}) writer.append(frame(t));
  writer.finish();
}

}  // namespace

TEST_CASE("recorders come back through the importer") {
  const Scratch scratch;
  write_history(scratch / "h.h5");
  const FemHistory before(scratch / "h.h5");
  CHECK(write_opensees_recorders(scratch / "out", before).empty());
  import_opensees(standard_names(scratch / "out"), scratch / "again.h5");
  const FemHistory after(scratch / "again.h5");
  CHECK(after.mesh().nodes == before.mesh().nodes);
  CHECK(after.mesh().elements == before.mesh().elements);
  CHECK(after.mesh().element_material == before.mesh().element_material);
  CHECK(after.times() == before.times());
  for (std::size_t i = 0; i < before.times().size(); ++i) {
    const FemFrame a = before.frame(i), b = after.frame(i);
    CHECK(a.displacement == b.displacement);
    CHECK(a.velocity == b.velocity);
    // Pa to kPa and back may turn the last bit.
    for (std::size_t n = 0; n < a.pore_pressure.size(); ++n)
      CHECK(b.pore_pressure[n] == Approx(a.pore_pressure[n]).epsilon(1e-14));
    for (std::size_t e = 0; e < a.stress.size(); ++e)
      for (int k = 0; k < 4; ++k) {
        CHECK(b.stress[e][k] == Approx(a.stress[e][k]).epsilon(1e-14));
        CHECK(b.strain[e][k] == a.strain[e][k]);
      }
  }
}
