#include "config/yaml.hpp"
#include "core/check.hpp"
#include "importers/opensees.hpp"
#include "small_model.hpp"

#include <catch2/catch.hpp>

using namespace flowslide;
using flowslide::test::SmallModel;

TEST_CASE("settings are read from a workflow file", "[importers]") {
  const SmallModel model;
  const auto file = model.folder.write("case.yaml", R"(
mesh: {nodes: nodeinfo.dat, elements: elementinfo.dat}
materials:
  tailings: {tag: 168, density: 1870 kg/m3, porosity: 0.5}
  foundation: {tag: 170, density: 1900 kg/m3}
units: {length: m, time: s, stress: kPa}
gravity: {stress: Gstress.out, strain: Gstrain.out, pore_pressure: GporePressure.out}
shaking:
  displacement: displacement.out
  velocity: velocity.out
  pore_pressure: porePressure.out
  stress: stress.out
  strain: strain.out
  stage: last
sigma_zz: {rule: elastic, nu: 0.3}
)");
  const auto config = read_settings<OpenSeesConfig>(load_yaml(file), "");
  CHECK(config.shaking->stage == StageChoice::last);
  CHECK(config.sigma_zz.nu == 0.3);
  CHECK(config.columns.stress == std::vector<std::string>{"xx", "yy", "xy"});
  CHECK(import_opensees(config, model.out()).num_frames == 3);
  const FemHistory history(model.out());
  REQUIRE(history.materials().size() == 2);
  CHECK(history.materials()[0].name == "tailings");
  CHECK(history.materials()[0].density == 1870.0);
  CHECK(history.materials()[0].porosity == 0.5);
  CHECK_FALSE(is_set(history.materials()[1].porosity));
}

TEST_CASE("every material of the model must be named", "[importers]") {
  SmallModel model;
  model.config.materials.erase("foundation");
  CHECK_THROWS_WITH(model.run_import(),
                    Catch::Contains("`materials`: element 20 has the material tag 170"));
  model.config.materials.clear();
  CHECK_THROWS_WITH(model.run_import(), Catch::Contains("tag: 168, density: 1870 kg/m3"));
}
