#include "config/yaml.hpp"
#include "fem/build_model.hpp"
#include "fem/gravity.hpp"
#include "section/mesh_section.hpp"
#include "tests/support/paths.hpp"
#include "workflows/stages/fem_run.hpp"

#include <catch2/catch.hpp>

using namespace flowslide;

namespace {

struct Rest {
  double far_gradient = 0.0;  ///< sigma'_v0 over depth far upstream, mean over the tailings [Pa/m]
  double under_pond = 0.0;    ///< sigma'_v0 18 m below the pond, mean over x -70..-50 [Pa]
  double out_of_balance = 0.0;
};

/// The dam of workflows/mochikoshi.yaml under its own weight.
Rest at_rest(const std::vector<std::string>& changes) {
  const YamlNode stages =
      *load_yaml(test::source("workflows/mochikoshi.yaml"), changes).find("stages");
  const SectionMesh section = mesh_section(
      read_settings<SectionConfig>(stages.find("mesh")->find("with"), "stages.mesh.with"));
  const auto config =
      read_settings<FemRunConfig>(stages.find("shake")->find("with"), "stages.shake.with");
  fem::Solver s = fem::make_solver(fem::build_model(section, config), {});
  solve_gravity(s, {config.gravity.permeability.value_or(kUnset), config.gravity.compacts});
  Rest r;
  double far = 0.0, pond = 0.0;
  for (std::size_t k = 0; k < s.layout.order.size(); ++k) {
    const std::int32_t e = s.layout.order[k];
    if (static_cast<std::size_t>(e) >= section.mesh.num_elements()) continue;
    if (section.mesh.element_material[e] != 168) continue;
    Vec2 c{};
    for (const std::int32_t n : section.mesh.elements[e])
      for (int d = 0; d < 2; ++d) c[d] += 0.25 * section.mesh.nodes[n][d];
    const double depth = 30.0 - c[1], vertical = -s.state.stress[k][1];
    if (c[0] < -250.0) {
      r.far_gradient += vertical / depth;
      far += 1.0;
    }
    if (c[0] > -70.0 && c[0] < -50.0 && std::abs(depth - 18.0) < 1.5) {
      r.under_pond += vertical * 18.0 / depth;
      pond += 1.0;
    }
  }
  r.far_gradient /= far;
  r.under_pond /= pond;
  r.out_of_balance = out_of_balance(s);
  return r;
}

}  // namespace

TEST_CASE("The dam of the workflow rests on water that stands") {
  const Rest r = at_rest({});
  CHECK(r.out_of_balance < 1e-10);
  CHECK(r.far_gradient == Approx((1870.0 - 1000.0) * kGravity).epsilon(0.01));
  // Level ground has 153 kPa; some water seeps to the toe below the pond's end.
  CHECK(r.under_pond > 150e3);
  CHECK(r.under_pond < 1.1 * 153e3);
}

TEST_CASE("With the soils' own permeabilities the foundation drains the tailings") {
  const Rest r = at_rest({"stages.shake.with.gravity.permeability=null"});
  CHECK(r.under_pond > 1.5 * 153e3);
}
