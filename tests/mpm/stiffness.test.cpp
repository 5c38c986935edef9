#include "mpm/run/stiffness.hpp"

#include "tests/mpm/scene.hpp"
#include "tests/support/scratch.hpp"

#include <algorithm>

#include <catch2/catch.hpp>

using namespace flowslide;
using namespace flowslide::mpm;
using Catch::Matchers::Contains;

namespace {

/// Undrained soil, 4 m high and wide, under its own weight from the start.
ParticleSet column() {
  ParticleSet p;
  p.toe = 4.0;
  p.materials = {liquefied(20e6, 8e3)};
  add_lattice(p, {0.0, 0.0, 4.0, 4.0}, 0.25, 1800.0);
  for (std::size_t q = 0; q < p.size(); ++q)
    p.stress[q].fill(0.0),
        std::fill_n(p.stress[q].begin(), 3, -1800.0 * 9.81 * (4.0 - p.position[q][1]));
  return p;
}

FlowConfig collapse(Stiffness stiffness) {
  FlowConfig c = free_space(0.5);
  c.transfer = Transfer::aflip;
  c.gravity = 9.81;
  c.ground.surface = {{0.0, 0.0}};
  c.left_roller = 0.0;
  c.end = 1.5;
  c.frame_interval = 0.1;
  c.stiffness = stiffness;
  return c;
}

struct Outcome {
  FlowFacts facts;
  /// Elastic, of all but one in a hundred points, largest over time [-].
  double volume_change = 0.0;
  double speed = 0.0;  ///< of the fastest point [m/s]
  MaterialSpec ran;    ///< as the history has it
};

Outcome run(const FlowConfig& c) {
  const Scratch folder;
  Outcome o{run_flow(column(), c, {folder / "mpm.h5", folder / "checkpoint"}, 1, {}), 0.0, 0.0, {}};
  const MpmHistory history(folder / "mpm.h5");
  o.ran = history.initial().materials[0];
  const auto& given = o.ran.parameters;
  const Elasticity e =
      Elasticity::from_young(given.at("youngs_modulus"), given.at("poisson_ratio"));
  for (std::size_t f = 0; f < history.num_frames(); ++f) {
    std::vector<double> change;
    for (const auto& s : history.frame(f).stress)
      change.push_back(std::abs(s[0] + s[1] + s[2]) / (3.0 * e.bulk));
    const auto most = change.begin() + std::ssize(change) * 99 / 100;
    std::nth_element(change.begin(), most, change.end());
    o.volume_change = std::max(o.volume_change, *most);
  }
  for (const MpmSample& s : history.samples()) o.speed = std::max(o.speed, s.max_speed);
  return o;
}

}  // namespace

TEST_CASE("The bulk modulus follows from weight, fall and bounds, and never rises", "[mpm]") {
  // 35 m: v^2 = 2 g H = 686.7 m2/s2, weight 642 kPa.
  const double speed = fall_speed(9.81, 35.0), pressure = 1870.0 * 9.81 * 35.0;
  CHECK(speed * speed == Approx(686.7));
  CHECK(needed_bulk({0.01, 0.1}, 1870.0, pressure, speed) == Approx(128.41e6).epsilon(1e-4));
  CHECK(needed_bulk({0.001, 0.1}, 1870.0, pressure, speed) == Approx(642.1e6).epsilon(1e-3));

  const Elasticity undrained = Elasticity::from_young(20e6, 0.49);
  const Elasticity softer = no_stiffer(undrained, 128e6, 0.0);
  CHECK(softer.bulk == 128e6);
  CHECK(softer.shear == undrained.shear);
  const Elasticity soft = no_stiffer(undrained, 14e6, 0.0),
                   at_045 = Elasticity::from_young(1.0, 0.45);
  CHECK(soft.shear / soft.bulk == Approx(at_045.shear / at_045.bulk));
  const Elasticity drained = Elasticity::from_young(2e9, 0.3),
                   less = no_stiffer(drained, 128e6, 0.0);
  CHECK(less.shear / less.bulk == Approx(drained.shear / drained.bulk));
  CHECK(no_stiffer(drained, 1e12, 0.0).bulk == drained.bulk);
  // Softening asks for a shear modulus, and Poisson's ratio stays.
  const Elasticity softening = no_stiffer(drained, 128e6, 300e6);
  CHECK(softening.shear == Approx(300e6));
  CHECK(softening.shear / softening.bulk == Approx(drained.shear / drained.bulk));
  CHECK(no_stiffer(drained, 128e6, 1e12).shear == drained.shear);
}

TEST_CASE("Soil as soft as its flow allows keeps the bounds in a third of the steps", "[mpm]") {
  const Outcome given = run(collapse(Stiffness::given));
  const Outcome chosen = run(collapse(Stiffness::automatic));
  FlowConfig loose = collapse(Stiffness::automatic);
  loose.stiffness_bounds = {0.2, 1.0};
  const Outcome control = run(loose);

  CHECK_FALSE(given.facts.stiffness);
  REQUIRE(chosen.facts.stiffness);
  const StiffnessOfMaterial& m = chosen.facts.stiffness->materials.at(0);
  const double highest = 4.0 - 0.125;  // of the points
  CHECK(m.used.bulk == Approx(1800.0 * 2.0 * 9.81 * highest / 0.01));
  CHECK(m.mach_number == Approx(0.1));
  CHECK(m.volume_change == Approx(0.005));
  CHECK(chosen.ran.parameters.at("poisson_ratio") == Approx(0.45));
  CHECK(given.ran.parameters == column().materials[0].parameters);

  // Fastest waves sqrt((K + 2 G) / rho): 31.3 to 1.
  CHECK(double(given.facts.steps) / double(chosen.facts.steps) > 3.0);
  CHECK(chosen.volume_change < 0.01);
  CHECK(control.volume_change > 0.02);
  CHECK(std::abs(control.facts.last.front_95 - given.facts.last.front_95) > 0.5);
  CHECK(chosen.speed < 0.1 * std::sqrt(m.used.bulk / 1800.0));
  // The front is known to half a cell.
  CHECK(given.facts.last.runout > 1.0);
  CHECK(std::abs(chosen.facts.last.front_95 - given.facts.last.front_95) < 0.25);
}

TEST_CASE("Softness is told, and soil that is softer is left as it is", "[mpm]") {
  ParticleSet p = column();
  p.materials.push_back(elastic(1e6, 0.3));
  p.materials.back().name = "core";
  add_lattice(p, {0.0, 4.0, 4.0, 4.5}, 0.25, 1800.0, 1);
  const auto before = p.materials;
  const StiffnessChoice choice = soften(p, collapse(Stiffness::automatic));
  CHECK(p.materials[1].parameters == before[1].parameters);
  CHECK(p.materials[0].parameters != before[0].parameters);
  const std::vector<std::string> sentences = told(choice);
  REQUIRE(sentences.size() == 2);
  CHECK_THAT(sentences[0], Contains("'liquefied' runs with a bulk modulus of") &&
                               Contains("instead of 333 MPa") && Contains("0.45 instead of 0.49"));
  CHECK_THAT(sentences[1], Contains("'core' stays as given") && Contains("Mach number"));
}

TEST_CASE("Softening faster than the soil unloads is told, with the rate by hand", "[mpm]") {
  ParticleSet p;
  p.materials = {{"dam",
                  "mohr_coulomb",
                  {{"youngs_modulus", 20e6},
                   {"poisson_ratio", 0.3},
                   {"cohesion", 25e3},
                   {"friction_angle", 35.0 * kPi / 180.0},
                   {"residual_cohesion", 1e3},
                   {"residual_friction_angle", 20.0 * kPi / 180.0},
                   {"peak_strain", 0.01},
                   {"residual_strain", 0.05}},
                  true}};
  add_lattice(p, {0.0, 0.0, 5.0, 5.0}, 1.25, 1700.0);
  for (auto& s : p.stress) s = {-300e3, -300e3, -300e3, 0.0, 0.0, 0.0};
  FlowConfig c = free_space(2.5);
  c.softening.reference_length = 1.25;
  // 25 cos 35 - cos 20 + 300 (sin 35 - sin 20) = 89.0 kPa over a strain of 0.04 / 2.
  const double slope = softening_slopes(p, c, {300e3})[0];
  CHECK(slope == Approx(89.0e3 / 0.02).epsilon(1e-3));
  CHECK(snapping_soils(p, c).empty());  // G is 7.69 MPa
  p.materials[0].parameters["youngs_modulus"] = 6e6;
  CHECK_THAT(snapping_soils(p, c).at(0), Contains("'dam'") && Contains("1.1 times"));
  c.cell = 1.25;
  CHECK(snapping_soils(p, c).empty());

  // A soil that softens keeps the stiffness that it needs for it.
  c.stiffness_bounds.brittleness = 0.02;
  p.materials[0].parameters["youngs_modulus"] = 2e9;
  c.ground.surface = {{0.0, 0.0}};
  c.gravity = 9.81;
  const StiffnessOfMaterial m = soften(p, c).materials.at(0);
  CHECK(m.used.bulk < m.given.bulk);
  CHECK(m.used.bulk > 1.5 * m.needed);
  CHECK(m.brittleness == Approx(0.02));
}
