#include "core/elementary.hpp"
#include "verify/mpm/list.hpp"
#include "verify/mpm/periodic.hpp"

#include <algorithm>
#include <cmath>

/// Layers of constant depth on an incline that goes on for ever: V10, soil that slides on its rough
/// base; V11, the steady flow of a Bingham fluid, and of a Newtonian one.
namespace flowslide::mpm {
namespace {

constexpr double kDepth = 1.0;

/// A layer in its own weight; gravity acts under `angle` to the normal of the ground.
struct Layer {
  double angle, density, cell;
  double above = 0.0;  ///< of the ground above a line of nodes [cells]
  BasisKind basis = BasisKind::quadratic;
  [[nodiscard]] ParticleSet points(const MaterialSpec& soil, bool sheared) const {
    ParticleSet p;
    p.materials = {soil};
    fill(p, {0.0, 0.0, 4.0 * cell, kDepth}, 0.5 * cell, density);
    for (std::size_t q = 0; q < p.size(); ++q) {
      const double weight = density * kGravity * (kDepth - p.position[q][1]);
      const double normal = -weight * cos(angle);
      p.stress[q] = {normal, normal, normal, sheared ? weight * sin(angle) : 0.0, 0.0, 0.0};
    }
    return p;
  }
  [[nodiscard]] PeriodicStrip strip(const MaterialSpec& soil, bool sheared,
                                    Transfer transfer) const {
    FlowConfig config = free_space(cell);
    config.transfer = transfer;
    config.ground.surface = {{0.0, 0.0}};
    config.ground.friction = 1e6;
    config.grid_origin[1] = -above * cell;
    config.basis = basis;
    PeriodicStrip s(points(soil, sheared), 4.0 * cell, config);
    s.trial.sim.gravity = {kGravity * sin(angle), -kGravity * cos(angle), 0.0};
    return s;
  }
};

/// Mean velocity along the ground [m/s].
double mean_velocity(const PeriodicStrip& s) {
  const Points<2>& q = s.trial.sim.points;
  double sum = 0.0, count = 0.0;
  s.for_each([&](std::size_t i) {
    sum += q.v[0][i];
    count += 1.0;
  });
  return sum / count;
}

/// Mean acceleration of the layer between 0.1 and 0.2 s [m/s2].
double slide_acceleration(const Layer& layer, const MaterialSpec& soil, Transfer transfer) {
  PeriodicStrip s = layer.strip(soil, true, transfer);
  s.run_to(0.1);
  const double v = mean_velocity(s), t = s.trial.sim.time;
  s.run_to(0.2);
  return (mean_velocity(s) - v) / (s.trial.sim.time - t);
}

/// How much the place of the ground between lines of nodes moves the acceleration, over `exact`.
double spread(Layer layer, const MaterialSpec& soil, double exact) {
  double low = exact, high = 0.0;
  for (int i = 0; i < 16; ++i) {
    layer.above = i / 16.0;
    const double a = slide_acceleration(layer, soil, Transfer::aflip);
    low = std::min(low, a);
    high = std::max(high, a);
  }
  return (high - low) / exact;
}

MaterialSpec tresca(double strength) {
  return material("residual_strength", {{"youngs_modulus", 1000.0 * strength},
                                        {"poisson_ratio", 0.45},
                                        {"strength", strength},
                                        {"soft_strength", strength},
                                        {"residual_strain", 0.0},
                                        {"tension_cutoff", strength}});
}

struct SheetFlow {
  double plug, profile;  ///< velocity of the plug [m/s]; rms error of the profile over it
};

SheetFlow sheet(double cell, double yield_stress) {
  constexpr double density = 1000.0, viscosity = 1000.0;
  const Layer layer{20.0 * kPi / 180.0, density, cell};
  const MaterialSpec fluid =
      yield_stress > 0.0
          ? material(
                "bingham",
                {{"bulk_modulus", 2e6}, {"viscosity", viscosity}, {"yield_stress", yield_stress}})
          : material("newtonian_fluid", {{"bulk_modulus", 2e6}, {"viscosity", viscosity}});
  PeriodicStrip s = layer.strip(fluid, false, Transfer::apic);
  s.run_to(5.0);  // twelve times the slowest time constant 4 rho d^2 / (pi^2 eta)
  const double weight = density * kGravity * sin(layer.angle);
  const double sheared = kDepth - yield_stress / weight;
  const double plug = 0.5 * weight * sheared * sheared / viscosity;
  const Points<2>& q = s.trial.sim.points;
  double sum = 0.0, count = 0.0, top = 0.0, top_count = 0.0;
  s.for_each([&](std::size_t i) {
    const double y = std::min(q.x[1][i], sheared);
    const double exact = weight / viscosity * (sheared * y - 0.5 * y * y);
    sum += pow(q.v[0][i] - exact, 2);
    count += 1.0;
    if (q.x[1][i] < kDepth - cell) return;
    top += q.v[0][i];
    top_count += 1.0;
  });
  return {top / top_count, std::sqrt(sum / count) / plug};
}

}  // namespace

std::vector<Check> verify_infinite_slope(std::string_view name) {
  CheckList checks(name);
  const Layer layer{kPi / 6.0, 2000.0, kDepth / 16.0}, fine{kPi / 6.0, 2000.0, kDepth / 32.0};
  const double drive = kGravity * sin(layer.angle);
  // The soil slips 0.6 cells above the ground and leaves the rest behind: an error of first order.
  // It should hang little on where the ground lies between lines of nodes.
  constexpr double kSpread = 0.05;
  const auto check = [&](const std::string& label, const MaterialSpec& soil, double exact) {
    const double at_16 = slide_acceleration(layer, soil, Transfer::aflip);
    const double at_32 = slide_acceleration(fine, soil, Transfer::aflip);
    checks.near("acceleration_" + label, 2.0 * at_32 - at_16, exact, 0.02 * exact, "m/s2");
    checks.at_least("order_" + label, std::log2((exact - at_16) / (exact - at_32)), 0.9);
    checks.at_most("place_" + label, spread(layer, soil, exact), kSpread);
    Layer least_squares = layer;
    least_squares.basis = BasisKind::mls;
    checks.at_most("place_mls_" + label, spread(least_squares, soil, exact), kSpread);
  };
  for (const double share : {0.5, 0.8}) {
    const double c = share * layer.density * drive * kDepth;
    check(fmt::format("c{:g}", share), tresca(c), drive - c / (layer.density * kDepth));
  }
  // Without dilation the layer shears at tau = sigma_n sin(phi) (Davis 1968).
  const double phi = 20.0 * kPi / 180.0;
  check("phi20",
        material("mohr_coulomb", {{"youngs_modulus", 20e6},
                                  {"poisson_ratio", 0.3},
                                  {"cohesion", 0.0},
                                  {"friction_angle", phi}}),
        drive - kGravity * cos(layer.angle) * sin(phi));
  const double strong = 1.01 * layer.density * drive * kDepth;
  checks.error("stands_c1.01", slide_acceleration(layer, tresca(strong), Transfer::apic),
               0.01 * drive, "m/s2");
  return checks.take();
}

std::vector<Check> verify_sheet_flow(std::string_view name) {
  CheckList checks(name);
  for (const double yield_stress : {0.0, 1000.0}) {
    const char* label = yield_stress > 0.0 ? "bingham" : "newtonian";
    const double weight = 1000.0 * kGravity * sin(20.0 * kPi / 180.0);
    const double sheared = kDepth - yield_stress / weight;
    const double plug = 0.5 * weight * sheared * sheared / 1000.0;
    std::vector<double> size, error;
    for (const int cells : {8, 16, 32}) {
      const SheetFlow flow = sheet(kDepth / cells, yield_stress);
      size.push_back(1.0 / cells);
      error.push_back(flow.profile);
      if (cells == 32) {
        checks.near(fmt::format("surface_{}", label), flow.plug, plug, 0.01 * plug, "m/s");
        checks.error(fmt::format("profile_{}", label), flow.profile, 0.01);
      }
    }
    checks.at_least(fmt::format("order_{}", label), fitted_order(size, error), 1.9);
  }
  return checks.take();
}

}  // namespace flowslide::mpm
