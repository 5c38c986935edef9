#include "exporters/opensees_recorders.hpp"

#include "core/check.hpp"
#include "tests/model/scratch.hpp"
#include "tests/support/limited_files.hpp"
#include "tests/support/materials.hpp"

#include <catch2/catch.hpp>

using namespace flowslide;
using Catch::Matchers::Contains;

namespace {

QuadMesh one_cell() {
  QuadMesh m;
  m.nodes = {{0, 0}, {1, 0}, {1, 0.1}, {0, 0.1}};
  m.node_tags = {11, 12, 13, 14};
  m.elements = {{0, 1, 2, 3}};
  m.element_tags = {7};
  m.element_material = {168};
  return m;
}

FemFrame frame(double time, double velocity) {
  FemFrame f;
  f.time = time;
  f.displacement.assign(4, {0.1, 0.2});
  f.velocity.assign(4, {velocity, 0.0});
  f.pore_pressure = {1e3, 2e3, 3e3, 4e3};
  f.stress = {Stress<2>{{-50e3, -100e3, -60e3, 2e3}}};
  f.strain = {StrainIncrement<2>{{0.0, -1e-3, 0.0, 2e-3}}};
  return f;
}

}  // namespace

TEST_CASE("recorders have time, then components in the order of OpenSees") {
  const Scratch scratch;
  FemHistoryWriter writer(scratch / "h.h5", one_cell(), test::materials_of(one_cell()), {});
  writer.set_gravity(frame(0.0, 0.0));
  writer.append(frame(0.25, 1.0));
  writer.finish();
  const auto notes = write_opensees_recorders(scratch / "out", FemHistory(scratch / "h.h5"));
  CHECK(bytes_of(scratch / "out/nodeinfo.dat") == "11 0 0\n12 1 0\n13 1 0.1\n14 0 0.1\n");
  CHECK(bytes_of(scratch / "out/elementinfo.dat") == "7 11 12 13 14 168\n");
  CHECK(bytes_of(scratch / "out/Gstress.out") == "0 -50 -100 2\n");
  CHECK(bytes_of(scratch / "out/strain.out") == "0.25 0 -0.001 0.002\n");
  CHECK(bytes_of(scratch / "out/porePressure.out") == "0.25 1 2 3 4\n");
  CHECK(bytes_of(scratch / "out/velocity.out") == "0.25 1 0 1 0 1 0 1 0\n");
  REQUIRE(notes.size() == 1);
  CHECK_THAT(notes[0], Contains("out-of-plane") && Contains("15 kPa"));
}

TEST_CASE("what text cannot say is refused") {
  const Scratch scratch;
  FemHistoryWriter writer(scratch / "h.h5", one_cell(), test::materials_of(one_cell()), {});
  writer.set_gravity(frame(0.0, 0.0));
  writer.append(frame(0.25, kUnset));
  writer.finish();
  const FemHistory history(scratch / "h.h5");
  CHECK_THROWS_WITH(write_opensees_recorders(scratch / "out", history),
                    Contains("velocity.out") && Contains("0.25"));
  CHECK_FALSE(std::filesystem::exists(scratch / "out/velocity.out"));
  put_bytes(scratch / "file", "x");
  CHECK_THROWS_AS(write_opensees_recorders(scratch / "file/out", history), FileError);
}

TEST_CASE("recorders on a full disk are whole or not there") {
  const Scratch scratch;
  FemHistoryWriter writer(scratch / "h.h5", one_cell(), test::materials_of(one_cell()), {});
  writer.set_gravity(frame(0.0, 0.0));
  for (int k = 1; k < 40; ++k) writer.append(frame(k / 3.0, k / 7.0));
  writer.finish();
  flowslide::test::check_limited_files(
      [&](const std::filesystem::path& folder) {
        write_opensees_recorders(folder / "out", FemHistory(scratch / "h.h5"));
      },
      20);
}
