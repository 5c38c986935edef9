#include "config/yaml.hpp"
#include "fem/build_model.hpp"
#include "fem/gravity.hpp"
#include "importers/mesh_import.hpp"
#include "section/boundary.hpp"
#include "tests/support/paths.hpp"
#include "workflows/stages/fem_run.hpp"

#include <cmath>
#include <fstream>

#include <catch2/catch.hpp>

using namespace flowslide;

namespace {

/// The dam of docs/against-opensees.yaml under its own weight.
fem::Solver at_rest(const std::vector<std::string>& changes) {
  const YamlNode stages =
      *load_yaml(test::source("docs/against-opensees.yaml"), changes).find("stages");
  SectionMesh section = import_mesh(
      read_settings<MeshImportConfig>(stages.find("mesh")->find("with"), "stages.mesh.with"));
  add_outer_sets(section);
  const auto config =
      read_settings<FemRunConfig>(stages.find("shake")->find("with"), "stages.shake.with");
  fem::Solver s = fem::make_solver(fem::build_model(section, config), {});
  solve_gravity(s, {config.gravity.permeability.value_or(kUnset), config.gravity.compacts});
  return s;
}

/// Root mean square of the difference of vertical stress from OpenSees', over that stress.
double off(const fem::Solver& s) {
  std::ifstream in(test::fixture("opensees/dam-rio270/Gstress.out"));
  std::vector<double> row;
  for (double x; in >> x;) row.push_back(1e3 * x);
  double difference = 0.0, size = 0.0;
  for (std::size_t k = 0; k < s.layout.order.size(); ++k) {
    // without the columns, whose tags are new
    const auto e = static_cast<std::size_t>(s.layout.order[k]);
    if (e >= 1835) continue;
    const auto tag = static_cast<std::size_t>(s.model.mesh.element_tags[e]);
    const double theirs = row[1 + 3 * (tag - 1) + 1];
    difference += std::pow(s.state.stress[k][1] - theirs, 2);
    size += theirs * theirs;
  }
  return std::sqrt(difference / size);
}

}  // namespace

TEST_CASE("The dam that is compared with OpenSees rests as it does there") {
  const fem::Solver s = at_rest({});
  CHECK(s.model.mesh.num_elements() == 1849);
  CHECK(off(s) < 0.02);
  // control: heavier tailings
  CHECK(off(at_rest({"stages.shake.with.materials.tailings.density=2000 kg/m3"})) > 0.03);
}

TEST_CASE("Divided elements rest as the whole ones do") {
  const fem::Solver whole = at_rest({}), parts = at_rest({"stages.mesh.with.divide=1"});
  CHECK(parts.model.mesh.num_elements() == 4 * 1835 + 2 * 2 * 7);
  const auto weight = [](const fem::Solver& s) {
    double sum = 0.0;
    for (const double w : s.layout.weight) sum += w;
    return sum;
  };
  CHECK(weight(parts) == Approx(weight(whole)));
}
