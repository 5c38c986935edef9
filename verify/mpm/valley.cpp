#include "core/conventions.hpp"
#include "mpm/run/load.hpp"
#include "mpm/solver/balance.hpp"
#include "verify/mpm/dam.hpp"
#include "verify/mpm/list.hpp"

#include <algorithm>

/// The dam as a straight valley between smooth walls is the dam in plane strain.
namespace flowslide::mpm {
namespace {

struct DamSlide {
  double front;   ///< x beyond which 1 % of the mass lies [m]
  double centre;  ///< how far the centre of mass has moved [m]
  double energy_error;
};

template <int Dim>
DamSlide slide_dam(const DamScene& scene, double end) {
  const ParticleSet particles = dam_points(scene);
  const FlowConfig config = dam_config(scene);
  Simulation<Dim> s = make_simulation<Dim>(particles, config);
  StepScratch<Dim> scratch(1);
  prepare(s, scratch, true);
  const Reference<Dim> start{sum_points(s), 0.0};
  const auto centre = [&] {
    double moment = 0.0, mass = 0.0;
    for (std::size_t q = 0; q < s.points.size(); ++q) {
      moment += s.points.mass[q] * s.points.x[0][q];
      mass += s.points.mass[q];
    }
    return moment / mass;
  };
  const double before = centre();
  while (s.time < end) advance(s, scratch);
  std::vector<Place> buffer;
  const MpmSample now = sample(s, start, std::vector<bool>(s.materials.size(), true), buffer);
  return {now.front_99, centre() - before, now.energy_error};
}

}  // namespace

std::vector<Check> verify_valley(std::string_view name) {
  CheckList checks(name);
  constexpr double kEnd = 15.0;
  DamScene scene;
  scene.upstream = 120.0;
  const DamSlide plane = slide_dam<2>(scene, kEnd);
  scene.width = 10.0;
  const DamSlide valley = slide_dam<3>(scene, kEnd);
  checks.near("front", valley.front, plane.front, 0.5 * scene.cell, "m");
  checks.near("centre_of_mass", valley.centre, plane.centre, 0.01 * plane.centre, "m");
  checks.error("energy_balance", valley.energy_error, 0.01);
  // Control: without the walls the slab falls apart sideways and does not go as far.
  scene.walls = false;
  const DamSlide open = slide_dam<3>(scene, kEnd);
  checks.at_least("control_without_walls_front_off_m", std::abs(open.front - plane.front),
                  0.5 * scene.cell);
  return checks.take();
}

}  // namespace flowslide::mpm
