#include "model/mirror.hpp"

#include "importers/opensees.hpp"
#include "small_model.hpp"

#include <algorithm>
#include <cmath>

#include <catch2/catch.hpp>

using namespace flowslide;
using flowslide::test::DataFolder;
using flowslide::test::SmallModel;

TEST_CASE("a model with its toe on the left is turned around", "[importers]") {
  const SmallModel model;
  model.run_import();
  const FemHistory right(model.out());
  // The same model drawn from the other side: -x, and the sign of what is horizontal or shear.
  SmallModel drawn;
  DataFolder& to = drawn.folder;
  to.write("nodeinfo.dat", "1 0 0\n2 -1 0\n3 -2 0\n4 0 1\n5 -1 1\n6 -2 1\n");
  to.write("elementinfo.dat", "10 2 1 4 5 168\n20 3 2 5 6 170\n");
  const auto turned = [](int i, int n, int signed_one) { return i % n == signed_one ? -1.0 : 1.0; };
  const auto nodal = SmallModel::rows(1, 4, 12, [&](int i, int r) {
    return turned(i, 2, 0) * SmallModel::displacement(1 + i / 2, i % 2, r);
  });
  to.write("displacement.out", nodal);
  to.write("velocity.out", nodal);
  const auto stress = [&](int i, int r) {
    const double v = SmallModel::vertical(1 + i / 3, r);
    return turned(i, 3, 2) * (i % 3 == 0 ? 0.5 * v : i % 3 == 1 ? v : 0.125 * v);
  };
  const auto strain = [&](int i, int r) { return turned(i, 3, 2) * (1e-4 * (i + 1) + 1e-3 * r); };
  to.write("Gstress.out", SmallModel::rows(0, 1, 6, stress));
  to.write("Gstrain.out", SmallModel::rows(0, 1, 6, strain));
  to.write("stress.out", SmallModel::rows(1, 4, 6, stress));
  to.write("strain.out", SmallModel::rows(1, 4, 6, strain));
  drawn.run_import();
  CHECK(FemHistory(drawn.out()).mesh().nodes[2] == Vec2{-2.0, 0.0});  // the control
  drawn.config.mirror = true;
  CHECK(std::ranges::any_of(drawn.run_import().origin.notes,
                            [](const std::string& note) { return note.starts_with("mirrored"); }));
  const FemHistory left(drawn.out());
  CHECK(left.mesh().nodes == right.mesh().nodes);
  CHECK(left.mesh().elements == right.mesh().elements);
  CHECK(left.gravity().stress == right.gravity().stress);
  for (std::size_t k = 0; k < 3; ++k) {
    const FemFrame a = left.frame(k), b = right.frame(k);
    CHECK(a.displacement == b.displacement);
    CHECK(a.velocity == b.velocity);
    CHECK(a.stress == b.stress);
    for (std::size_t e = 0; e < 2; ++e) CHECK(a.strain[e].v == b.strain[e].v);
  }
}

TEST_CASE("A mirrored section keeps its elements, and its soil on the left of its edges") {
  // two squares in a row, x 0..2
  SectionMesh s;
  for (int i = 0; i < 6; ++i) {
    s.mesh.nodes.push_back({1.0 * (i % 3), i < 3 ? 0.0 : 1.0});
    s.mesh.node_tags.push_back(i);
  }
  s.mesh.elements = {{0, 1, 4, 3}, {1, 2, 5, 4}};
  s.mesh.element_tags = {7, 8};
  s.mesh.element_material = {1, 1};
  s.materials = {{"sand", 1}};
  s.sets = {{"below", {{0, 1}, {1, 2}}}, {"end", {{2, 5}}}, {"left", {{3, 0}}}};
  mirror(s);
  check(s);  // corners counter-clockwise, edges of elements
  CHECK(s.mesh.nodes[2] == Vec2{-2.0, 0.0});
  CHECK_FALSE(std::signbit(s.mesh.nodes[0][0]));
  CHECK(s.sets[0].edges == std::vector<std::array<std::int32_t, 2>>{{2, 1}, {1, 0}});
  CHECK(s.sets[2].name == "right");
  CHECK(s.sets[2].edges[0] == std::array<std::int32_t, 2>{0, 3});
}
