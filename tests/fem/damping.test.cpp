#include "fem/time_step.hpp"
#include "verify/fem/scene.hpp"

#include <catch2/catch.hpp>
#include <omp.h>

using namespace flowslide;
using namespace flowslide::fem;

namespace {

constexpr double kStiffness = 4e-3;  ///< [s]

/// A column of eight rows 1 m high, the fifth of which is a tenth of that.
SectionMesh column_with_thin_row() {
  SectionMesh mesh = section({.columns = 2, .rows = 8, .width = 4.0, .height = 8.0});
  for (Vec2& x : mesh.mesh.nodes)
    if (x[1] > 4.5) x[1] -= 0.9;
  return mesh;
}

FemConfig damped(std::optional<double> largest_ratio) {
  FemConfig c = config(elastic_soil(), -1.0);
  c.water.reset();
  c.damping.stiffness = kStiffness;
  c.damping.largest_ratio = largest_ratio;
  return c;
}

/// The first horizontal mode of the column as it decays: velocity of the surface after 0.25 s.
double free_vibration(Solver& s) {
  const auto& nodes = s.model.mesh.nodes;
  for (std::size_t e = 0; e < s.layout.elements.size(); ++e)
    for (int i = 0; i < 4; ++i) {
      const std::int32_t x = s.layout.dofs[e][2 * i];
      if (x < s.model.num_dofs)
        s.state.velocity[x] = 1e-3 * std::sin(0.5 * kPi * nodes[s.layout.nodes[e][i]][1] / 7.1);
    }
  const double end = 0.25;
  while (s.state.time < end) advance(s, {});
  double most = 0.0;
  for (const double v : s.state.velocity) most = std::max(most, std::abs(v));
  return most;
}

}  // namespace

TEST_CASE("Thin elements are damped as critical, and let the others step", "[fem]") {
  omp_set_num_threads(1);
  const SectionMesh mesh = column_with_thin_row();
  Solver all = at_rest(mesh, damped({}), 1.0), limited = at_rest(mesh, damped(1.0), 1.0);
  int changed = 0;
  double least = kStiffness;
  for (std::size_t e = 0; e < limited.stiffness_damping.size(); ++e) {
    changed += limited.stiffness_damping[e] < kStiffness;
    least = std::min(least, limited.stiffness_damping[e]);
  }
  CHECK(changed == 2);  // the row
  CHECK(0.5 * least * std::sqrt(soil_frequency(limited)) == Approx(1.0));
  // D = 1: dt = 2 / (1 + sqrt 2) / w, against 2 / (D + sqrt(1 + D^2)) / w for all.
  const double w = std::sqrt(soil_frequency(all)), ratio = 0.5 * kStiffness * w;
  CHECK(all.dt * w == Approx(2.0 / (ratio + std::sqrt(1.0 + ratio * ratio))));
  CHECK(limited.dt * w == Approx(2.0 / (1.0 + std::sqrt(2.0))));
  CHECK(limited.dt > 2.0 * all.dt);
  // What the column does as a whole, of which the row is a seventieth.
  const double a = free_vibration(all), b = free_vibration(limited);
  CHECK(b == Approx(a).epsilon(0.02));
  // Control: without stiffness damping it decays less.
  FemConfig none = damped({});
  none.damping.stiffness = 0.0;
  Solver undamped = at_rest(mesh, none, 0.5);
  CHECK(free_vibration(undamped) > 1.1 * a);
}

TEST_CASE("The step with limited damping is stable, and hardly longer ones are not", "[fem]") {
  omp_set_num_threads(1);
  // Equal elements, all of them limited: thin ones between others share the nodes' mass with those.
  const auto grows = [](double courant) {
    FemConfig c = damped(1.0);
    c.damping.stiffness = 10.0 * kStiffness;
    Solver s = at_rest(section({.columns = 2, .rows = 8, .width = 4.0, .height = 8.0}), c, courant);
    REQUIRE(s.stiffness_damping.front() < 0.5 * *c.damping.stiffness);
    for (std::size_t u = 0; u < s.state.velocity.size(); ++u)
      s.state.velocity[u] = 1e-6 * std::sin(7.0 * double(u * u));
    try {
      for (int k = 0; k < 2000; ++k) advance(s, {});
    } catch (const NumericsError&) {
      return true;
    }
    return s.state.energy.kinetic > 1.0;
  };
  CHECK_FALSE(grows(1.0));
  CHECK(grows(1.5));
}
