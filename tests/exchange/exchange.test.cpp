#include "core/check.hpp"
#include "exchange/convert.hpp"
#include "exchange/inspect.hpp"
#include "model/history.hpp"
#include "model/zone.hpp"
#include "tests/support/materials.hpp"
#include "tests/support/scratch.hpp"

#include <algorithm>
#include <vector>

#include <catch2/catch.hpp>
#include <fmt/format.h>

using namespace flowslide;
using Catch::Contains;

namespace {

QuadMesh one_quad() {
  QuadMesh m;
  m.nodes = {{0.0, 0.0}, {1.0, 0.0}, {1.0, 1.0}, {0.0, 1.0}};
  m.node_tags = {1, 2, 3, 4};
  m.elements = {{0, 1, 2, 3}};
  m.element_tags = {10};
  m.element_material = {168};
  return m;
}

void write_history(const std::filesystem::path& path) {
  FemHistoryWriter out(path, one_quad(), {{"tailings", 168, 1870.0}}, {"a test", "given", {}});
  FemFrame rest;
  rest.displacement.resize(4);
  rest.velocity.resize(4);
  rest.pore_pressure.resize(4);
  rest.stress.resize(1);
  rest.strain.resize(1);
  out.set_gravity(rest);
  out.finish();
}

}  // namespace

TEST_CASE("a file is told by what is in it") {
  const Scratch scratch;
  write_history(scratch / "h.h5");
  const Json j = inspect(scratch / "h.h5");
  CHECK(j["kind"] == "fem_history");
  CHECK(j["materials"]["tailings"]["tag"] == 168);
  CHECK(j["materials"]["tailings"]["density_kg_m3"] == 1870.0);
  scratch.write("r.out", "0.0 1 2\n0.1 3 4\n");
  CHECK(inspect(scratch / "r.out")["columns"] == 3);
  CHECK_THROWS_AS(inspect(scratch / "none"), FileError);
}

TEST_CASE("a long look tells how far it is") {
  const Scratch scratch;
  std::string rows;
  for (int i = 0; i < 20000; ++i) rows += fmt::format("{} 1.0 2.0\n", 0.01 * i);
  scratch.write("r.out", rows);
  std::vector<double> shares;
  const Json j = inspect(scratch / "r.out", [&](double share) { shares.push_back(share); });
  CHECK(j["rows"] == 20000);
  REQUIRE(!shares.empty());
  CHECK(std::is_sorted(shares.begin(), shares.end()));
  CHECK(shares.front() < 0.9);
  CHECK(shares.back() == 1.0);
}

TEST_CASE("an earthquake record is told from a recorder") {
  const Scratch scratch;
  scratch.write("a.csv", "time (s), acc (cm/s2)\n0,10\n0.01,-20\n0.02,30\n");
  const Json stated = inspect(scratch / "a.csv");
  CHECK(stated["kind"] == "record");
  CHECK(stated["unit"] == "cm/s2");
  CHECK(stated["samples"] == 3);
  CHECK(stated["pga_m_s2"].get<double>() == Approx(0.3));
  CHECK(stated["problems"].empty());
  scratch.write("b.csv", "time,acc\n0,10\n0.01,-20\n0.02,30\n");
  const Json silent = inspect(scratch / "b.csv");
  CHECK(silent["kind"] == "record");
  CHECK(silent["unit"] == "not stated");
  CHECK(silent["peak"] == 30.0);
  scratch.write("k.txt", "Sampling Freq(Hz) 100Hz\nScale Factor 1(gal)/2\n 1 2 3 4 5 6 7 8\n");
  CHECK_THAT(inspect(scratch / "k.txt")["problems"].dump(), Contains("K-NET"));
  scratch.write("odd.csv", "time (s), acc (g)\n0,10\n0.01,-20\n0.02,30\n");
  const Json odd = inspect(scratch / "odd.csv");
  CHECK(odd["problems"].empty());
  CHECK(odd["warnings"].size() == 1);
  scratch.write("r.out", "0.0 1\n0.1 3\n");
  CHECK(inspect(scratch / "r.out")["kind"] == "recorder");
  CHECK_THAT(inspect(scratch / "r.out")["notes"].dump(), Contains("flowslide motion"));
}

TEST_CASE("a terrain is told with its place and heights") {
  const Scratch scratch;
  const std::string header = "NCOLS 3\nnrows 2\nxllcorner 100\nyllcorner 50\ncellsize 10\n";
  scratch.write("v.asc", header + "nodata_value -9999\n1 2 3\n4 5 -9999\n");
  const Json j = inspect(scratch / "v.asc");
  CHECK(j["kind"] == "terrain");
  CHECK(j["cell_m"] == 10.0);
  CHECK(j["east_m"] == Json({105.0, 125.0}));
  CHECK(j["north_m"] == Json({55.0, 65.0}));
  CHECK(j["heights_m"] == Json({1.0, 5.0}));
  CHECK(j["missing"] == 1);
  scratch.write("cut.asc", header + "1 2 3\n");
  CHECK_THAT(inspect(scratch / "cut.asc")["problems"].dump(), Contains("ends after 1 rows"));
  scratch.write("turned.asc",
                "\n nrows 2\nncols 3\nxllcorner 1\nyllcorner 5\ncellsize 10\n1 2 3\n4 5 6\n");
  CHECK(inspect(scratch / "turned.asc")["kind"] == "terrain");
}

TEST_CASE("a conversion is chosen by both ends") {
  const Scratch scratch;
  write_history(scratch / "h.h5");
  CHECK_THROWS_WITH(convert({(scratch / "h.h5").string(), (scratch / "h.csv").string(), {}}),
                    Contains("no conversion") && Contains("history.h5 -> NAME.pvd"));
  convert({(scratch / "h.h5").string(), (scratch / "h.pvd").string(), {}});
  CHECK(std::filesystem::exists(scratch / "h/h_0000.vtu"));
  scratch.write("v.asc", "ncols 2\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 5\n1 2\n3 4\n");
  scratch.write("w.yaml", "schema: 1\n");
  for (const auto& [in, kind] : {std::pair{"v.asc", "'terrain'"}, {"w.yaml", "'workflow'"}})
    CHECK_THROWS_WITH(convert({(scratch / in).string(), (scratch / "x.csv").string(), {}}),
                      Contains(kind) && Contains("no conversion"));
}

TEST_CASE("a zone becomes the table of its depths over time") {
  const Scratch scratch;
  LiquefactionZone zone;
  zone.window_names = zone.history.window_names = {"crest"};
  for (std::vector<double>* of :
       {&zone.window_depth_max, &zone.window_depth_any, &zone.window_depth_interpolated,
        &zone.window_depth_strong, &zone.window_depth_before_slide})
    *of = {2.5};
  ZoneHistory& h = zone.history;
  h.time = {0.25, 0.5};
  h.depth = h.depth_max = h.depth_any = {{0.0, 2.5}};
  h.depth_interpolated = {{0.0, 3.25}};
  h.kinetic_energy = h.kinetic_energy_relative = h.sliding_energy = {1.0, 2.0};
  h.distortion_gauss = h.distortion_centre = {1.0, 1.0};
  write_zone(scratch / "zone.h5", zone);
  convert({(scratch / "zone.h5").string(), (scratch / "zone.csv").string(), {}});
  CHECK_THAT(read_text_file(scratch / "zone.csv"),
             Contains("depth_interpolated_crest_m") && Contains("\n0.5,2.5,2.5,2.5,3.25,"));
}
