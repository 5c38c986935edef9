#include "fem/permeability.hpp"

#include "model/history.hpp"
#include "tests/support/scratch.hpp"
#include "verify/fem/scene.hpp"

#include <algorithm>

#include <catch2/catch.hpp>

using namespace flowslide;
using namespace flowslide::fem;

TEST_CASE("Permeability grows from that at rest to its factor, and not beyond", "[fem]") {
  const PermeabilityRise rise{.factor = 5.0, .exponent = 2.0};
  CHECK(permeability_factor(rise, -0.3) == 1.0);
  CHECK(permeability_factor(rise, 0.0) == 1.0);
  CHECK(permeability_factor(rise, 0.5) == Approx(2.0));
  CHECK(permeability_factor(rise, 1.0) == Approx(5.0));
  CHECK(permeability_factor(rise, 3.0) == Approx(5.0));
}

TEST_CASE("The permeability of an element follows its own excess pore pressure", "[fem]") {
  FemConfig c = config(elastic_soil(), 4.0);
  c.materials["soil"].permeability_rise = PermeabilityRiseConfig{.factor = 5.0};
  Solver s = at_rest(section({}), c);
  const std::vector<double> before = s.water.mobility_y;
  refresh_permeability(s);
  CHECK(s.water.mobility_y == before);  // nothing was asked for yet
  let_permeability_rise(s);
  for (double& p : s.state.pressure) p += 4e3;
  refresh_permeability(s);
  for (std::size_t e = 0; e < before.size(); ++e) {
    const double r_u = std::min(1.0, 4e3 / -s.state.stress[e][1]);
    CHECK(s.water.mobility_y[e] == Approx(before[e] * (1.0 + 4.0 * r_u)));
    CHECK(s.water.mobility_x[e] == Approx(10.0 * s.water.mobility_y[e]));  // as at rest
  }
}

TEST_CASE("Explicit and implicit steps let the same water out of sand that liquefies", "[fem]") {
  const SectionMesh mesh = section({.columns = 1, .rows = 6, .width = 1.0, .height = 6.0});
  GroundMotion motion{.dt = 0.01, .acceleration = {}, .origin = "test"};
  for (int i = 0; i < 301; ++i)
    motion.acceleration.push_back(i < 200 ? 2.0 * std::sin(4.0 * kPi * motion.dt * i) : 0.0);
  const Scratch folder;
  const auto settlement = [&](double factor, IntegrationScheme scheme) {
    FemConfig c = config(sand(0.35, 476.0, 0.1), 6.0);
    c.materials["soil"].permeability = {1e-3, 1e-3};
    if (factor > 1.0) c.materials["soil"].permeability_rise = PermeabilityRiseConfig{factor, 1.0};
    c.damping.stiffness = 1e-3;
    c.integration.scheme = scheme;
    const std::string name = fmt::format(
        "{}-{}", factor, scheme == IntegrationScheme::implicit ? "implicit" : "explicit");
    run_fem(mesh, motion, c, {folder / (name + ".h5"), folder / (name + ".checkpoint")}, 1, {});
    const FemHistory h(folder / (name + ".h5"));
    return -h.frame(static_cast<int>(h.times().size()) - 1).displacement.back()[1];
  };
  const double steps = settlement(5.0, IntegrationScheme::explicit_steps);
  CHECK(steps == Approx(settlement(5.0, IntegrationScheme::implicit)).epsilon(0.03));
  CHECK(steps > 1.5 * settlement(1.0, IntegrationScheme::explicit_steps));  // control: constant
}
