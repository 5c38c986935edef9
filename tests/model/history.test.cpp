#include "model/history.hpp"

#include "core/check.hpp"
#include "model/field_store.hpp"
#include "tests/model/scratch.hpp"
#include "tests/support/materials.hpp"

#include <cmath>
#include <cstring>

#include <catch2/catch.hpp>

using namespace flowslide;
using Catch::Matchers::Contains;

namespace {

QuadMesh one_quad() {
  QuadMesh m;
  m.nodes = {{0, 0}, {1, 0}, {1, 1}, {0, 1.0 / 3.0}};
  m.node_tags = {4, 3, 2, 10000000000};
  m.elements = {{0, 1, 2, 3}};
  m.element_tags = {77};
  m.element_material = {5};
  return m;
}

FemFrame frame_at(double time) {
  FemFrame f;
  f.time = time;
  f.displacement.assign(4, {time / 3.0, -time / 7.0});
  f.velocity.assign(4, {kUnset, 1.0});
  f.pore_pressure.assign(4, 1e4 + time);
  f.stress = {{{-1.0, -2.0, -1.5, time}}};
  f.strain = {{{1e-3, -1e-3, 0.0, 2e-3 * time}}};
  return f;
}

template <class T>
bool same_bits(const std::vector<T>& a, const std::vector<T>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0;
}

bool same(const FemFrame& a, const FemFrame& b) {
  return a.time == b.time && same_bits(a.displacement, b.displacement) &&
         same_bits(a.velocity, b.velocity) && same_bits(a.pore_pressure, b.pore_pressure) &&
         same_bits(a.stress, b.stress) && same_bits(a.strain, b.strain);
}

void write_history(const std::filesystem::path& path, int frames) {
  FemHistoryWriter out(path, one_quad(), {{"sand", 5, 1900.0, 0.45, "pm4sand"}},
                       {"a test", "K0 of 0.5", {"first note", "", "third"}});
  out.set_gravity(frame_at(0.0));
  for (int i = 0; i < frames; ++i) out.append(frame_at(0.1 * (i + 1)));
  out.finish();
}

}  // namespace

TEST_CASE("a history comes back from the file to the bit") {
  const Scratch folder;
  write_history(folder / "h.h5", 3);
  const FemHistory h(folder / "h.h5");
  const QuadMesh mesh = one_quad();
  CHECK(same_bits(h.mesh().nodes, mesh.nodes));
  CHECK(h.mesh().node_tags == mesh.node_tags);
  CHECK(h.mesh().elements == mesh.elements);
  CHECK(h.mesh().element_tags == mesh.element_tags);
  CHECK(h.mesh().element_material == mesh.element_material);
  REQUIRE(h.materials().size() == 1);
  CHECK(h.materials()[0].name == "sand");
  CHECK(h.materials()[0].tag == 5);
  CHECK(h.materials()[0].density == 1900.0);
  CHECK(h.materials()[0].porosity == 0.45);
  CHECK(h.materials()[0].law == "pm4sand");
  CHECK(h.origin().program == "a test");
  CHECK(h.origin().sigma_zz_rule == "K0 of 0.5");
  CHECK(h.origin().notes == std::vector<std::string>{"first note", "", "third"});
  CHECK(same(h.gravity(), frame_at(0.0)));
  REQUIRE(h.times() == std::vector<double>{0.1 * 1, 0.1 * 2, 0.1 * 3});
  CHECK(same(h.frame(2), frame_at(0.1 * 3)));
  CHECK(same(h.frame(0), frame_at(0.1)));
  CHECK_THROWS_AS(h.frame(3), InputError);
  CHECK(stored_kind(folder / "h.h5") == "fem_history");
}

TEST_CASE("a history may hold the gravity state only") {
  const Scratch folder;
  write_history(folder / "h.h5", 0);
  const FemHistory h(folder / "h.h5");
  CHECK(h.times().empty());
  CHECK(same(h.gravity(), frame_at(0.0)));
}

TEST_CASE("equal histories give equal bytes") {
  const Scratch folder;
  write_history(folder / "a.h5", 4);
  // Other rubbish on the heap: bytes that HDF5 left uninitialised would differ.
  const std::vector<std::string> rubbish(500, std::string(777, 'x'));
  write_history(folder / "b.h5", 4);
  CHECK(rubbish.size() == 500);
  CHECK(bytes_of(folder / "a.h5") == bytes_of(folder / "b.h5"));
  write_history(folder / "c.h5", 3);
  CHECK(bytes_of(folder / "a.h5") != bytes_of(folder / "c.h5"));
}

TEST_CASE("an unfinished history leaves no file") {
  const Scratch folder;
  {
    FemHistoryWriter out(folder / "h.h5", one_quad(), test::materials_of(one_quad()), {});
    out.set_gravity(frame_at(0.0));
    out.append(frame_at(1.0));
    CHECK(folder.entries() == 1);
    CHECK_FALSE(std::filesystem::exists(folder / "h.h5"));
  }
  CHECK(folder.entries() == 0);
}

TEST_CASE("frames that do not fit are refused") {
  const Scratch folder;
  FemHistoryWriter out(folder / "h.h5", one_quad(), test::materials_of(one_quad()), {});
  CHECK_THROWS_WITH(out.append(frame_at(1.0)), Contains("gravity"));
  CHECK_THROWS_WITH(out.finish(), Contains("gravity"));
  out.set_gravity(frame_at(0.0));
  CHECK_THROWS_WITH(out.set_gravity(frame_at(0.0)), Contains("once"));
  out.append(frame_at(1.0));
  CHECK_THROWS_WITH(out.append(frame_at(1.0)), Contains("times must increase"));
  CHECK_THROWS_WITH(out.append(frame_at(kUnset)), Contains("times must increase"));
  FemFrame f = frame_at(2.0);
  f.stress.emplace_back();
  CHECK_THROWS_WITH(out.append(f), Contains("stress has 2 values") && Contains("1 elements"));
  f = frame_at(2.0);
  f.pore_pressure[3] = kUnset;
  CHECK_THROWS_WITH(out.append(f), Contains("pore_pressure") && Contains("nan"));
}
