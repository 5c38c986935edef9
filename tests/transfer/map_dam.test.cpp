#include "tests/support/scratch.hpp"
#include "tests/transfer/fixture_dam.hpp"
#include "transfer/map/map_state.hpp"

#include <cmath>
#include <filesystem>

#include <catch2/catch.hpp>

using namespace flowslide;

namespace {

/// The dam of the fixture at rest.
FemHistory import_at_rest() {
  const Scratch scratch;
  const auto out = scratch / "history.h5";
  import_opensees(test::fixture_dam(), out);
  return FemHistory(out);
}

/// All tailings have liquefied; S_r = 0.4616 sigma'_v0^0.576 in kPa.
LiquefactionZone all_tailings(const FemHistory& history) {
  const QuadMesh& mesh = history.mesh();
  LiquefactionZone z;
  z.r_u_node.assign(mesh.num_nodes(), 1.0);
  z.r_u_element.assign(mesh.num_elements(), 1.0);
  for (std::size_t e = 0; e < mesh.num_elements(); ++e) {
    const bool tailings = mesh.element_material[e] == 168;
    const double sigma_v0 = std::max(1.0, -history.gravity().stress[e][1] / 1e3);
    z.liquefied.push_back(tailings ? 1 : 0);
    z.strength.push_back(tailings ? 461.6 * std::pow(sigma_v0, 0.576) : kUnset);
  }
  return z;
}

MapMaterial soil(double cohesion, double friction) {
  MapMaterial m;
  m.law.of<MohrCoulomb>().emplace();
  m.law.of<MohrCoulomb>()->youngs_modulus = 20e6;
  m.law.of<MohrCoulomb>()->poisson_ratio = 0.3;
  m.law.of<MohrCoulomb>()->cohesion = cohesion;
  m.law.of<MohrCoulomb>()->friction_angle = friction;
  return m;
}

MapConfig dam() {
  MapConfig c;
  c.cell = 1.25;
  c.c_soft_ratio = 0.5;
  c.box = {-340.0, 87.5, -5.0, 100.0};
  c.materials = {{"embankment", soil(25e3, 0.611)}, {"tailings", soil(1e3, 0.524)}};
  c.materials["tailings"].liquefied.emplace();
  c.materials["tailings"].liquefied->youngs_modulus = 5e6;
  c.materials["tailings"].liquefied->poisson_ratio = 0.49;
  MapMaterial& foundation = c.materials["foundation"];
  foundation.law.of<LinearElastic>() = LinearElastic::Params{100e6, 0.3};
  foundation.counts_for_runout = false;
  return c;
}

}  // namespace

TEST_CASE("The dam of the fixture is handed over within the limits of the audit", "[transfer]") {
  const FemHistory history = import_at_rest();
  const LiquefactionZone zone = all_tailings(history);
  MapConfig c = dam();
  const MapResult r = map_state(history, zone, c);
  CHECK(r.audit.passed());
  CHECK(r.particles.toe ==
        Approx(75.0).epsilon(1e-9));  // of the embankment; the foundation goes on
  CHECK(r.audit.mapped.nodes > 1000);
  CHECK(r.audit.mapped.rms < 0.02);

  double mass = 0.0, volume = 0.0;
  for (std::size_t i = 0; i < r.particles.size(); ++i) {
    mass += r.particles.mass[i];
    volume += r.particles.volume[i];
  }
  double foundation = 0.0;
  for (const AuditMaterial& m : r.audit.materials)
    if (m.name == "foundation") foundation = m.volume;
  CHECK(foundation == Approx(427.5 * 5.0).epsilon(1e-6));
  CHECK(mass / volume > 1690.0);
  CHECK(mass / volume < 1900.0);

  // Keeping the vertical stress leaves the overburden carried; keeping the mean stress does not.
  c.liquefied_return = LiquefiedReturn::mean_stress;
  CHECK(map_state(history, zone, c).audit.returned.rms > 2.0 * r.audit.returned.rms);

  // Effective stress has a kink at the water table, total stress has none.
  c.mapped_stress = MappedStress::effective;
  c.audit.enforce = false;
  CHECK(map_state(history, zone, c).audit.mapped.rms > 1.3 * r.audit.mapped.rms);
}
