#include "exporters/cbgeo_csv.hpp"

#include "core/check.hpp"
#include "tests/support/limited_files.hpp"
#include "tests/support/scratch.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

using namespace flowslide;
using Catch::Matchers::Contains;

namespace {

ParticleSet one_point() {
  ParticleSet p;
  p.position = {{-337.64781151420004, 30.0, 0.0}};
  p.velocity = {{1e-5, 0.0, 0.0}};
  p.displacement = {{0.1, -2.5e-17, 0.0}};
  p.mass = {1870.0};
  p.volume = {2.25};
  p.stress = {{-1e5, -2e5, 0.0, 1e16, 0.0, 0.0}};
  p.pore_pressure = {7.0};
  p.material = {0};
  p.id = {41};
  p.materials = {{"liquefied 175", "mohr_coulomb", {}, true}};
  return p;
}

std::vector<std::string> lines(const std::filesystem::path& path) {
  std::ifstream in(path);
  std::vector<std::string> r;
  for (std::string line; std::getline(in, line);) r.push_back(line);
  return r;
}

}  // namespace

TEST_CASE("the table has 53 columns and spells numbers as the script does") {
  const Scratch folder;
  ParticleSet p = one_point();
  p.history = {{"strain_xx", {-4.9e-5}}, {"epsilon_v", {0.0}},   {"material_id", {175.0}},
               {"nstate_vars", {7.0}},   {"svars_0", {0.0}},     {"svars_2", {20000.0}},
               {"svars_6", {0.0}},       {"not_a_column", {9.0}}};
  write_cbgeo_csv(folder / "p.csv", p);
  const std::vector<std::string> text = lines(folder / "p.csv");
  REQUIRE(text.size() == 2);
  CHECK_THAT(text[0], Catch::Matchers::StartsWith("id,mass,volume,pressure,coord_x,"));
  CHECK_THAT(text[0], Contains("epsilon_v,status,cell_id,material_id,nstate_vars,svars_0,"));
  CHECK(std::count(text[0].begin(), text[0].end(), ',') == 52);
  // Python: integers stay integers, floats have a point or an exponent of two digits.
  CHECK(text[1] ==
        "41,1870.0,2.25,0,-337.64781151420004,30.0,0,0.1,-2.5e-17,0,1.5,1.5,0,1e-05,0.0,0,"
        "-100000.0,-200000.0,0,1e+16,0,0,-4.9e-05,0.0,0,0.0,0,0,0.0,1,18446744073709551615,175,7,"
        "0.0,0,20000,0,0,0,0.0,0,0,0,0,0,0,0,0,0,0,0,0,0");
}

TEST_CASE("points without script columns are written with zeros and material indices") {
  const Scratch folder;
  ParticleSet p = one_point();
  p.stress[0][2] = -1.5e5;
  write_cbgeo_csv(folder / "p.csv", p);
  CHECK_THAT(lines(folder / "p.csv").at(1), Contains(",-100000.0,-200000.0,-150000.0,1e+16,"));
  CHECK_THAT(lines(folder / "p.csv").at(1), Contains("18446744073709551615,0,0,0,0,0,"));
}

TEST_CASE("a table that cannot be written says so") {
  ParticleSet p = one_point();
  CHECK_THROWS_AS(write_cbgeo_csv("/nonexistent-folder/p.csv", p), FileError);
  p.dim = 3;
  CHECK_THROWS_WITH(write_cbgeo_csv("p.csv", p), Contains("plane strain"));
}

TEST_CASE("a table on a full disk is whole or not there") {
  ParticleSet p = one_point();
  resize(p, 400);
  test::check_limited_files(
      [&](const std::filesystem::path& folder) { write_cbgeo_csv(folder / "p.csv", p); }, 20);
}
