#include "mpm/run/extrude.hpp"
#include "tests/bits/digest.hpp"
#include "tests/bits/scenes.hpp"
#include "tests/mpm/scene.hpp"

namespace flowslide::same_bits {
namespace {

using namespace mpm;

const std::vector<MaterialSpec>& materials() {
  static const std::vector<MaterialSpec> all = [] {
    std::vector<MaterialSpec> m;
    const auto add = [&](const std::string& law, std::map<std::string, double> parameters) {
      m.push_back({law, law, std::move(parameters), true});
    };
    const double young = 2e6;
    add("linear_elastic", {{"youngs_modulus", young}, {"poisson_ratio", 0.3}});
    add("neo_hookean", {{"youngs_modulus", young}, {"poisson_ratio", 0.3}});
    add("mohr_coulomb", {{"youngs_modulus", young},
                         {"poisson_ratio", 0.3},
                         {"cohesion", 2e3},
                         {"friction_angle", 0.5},
                         {"residual_cohesion", 5e2},
                         {"residual_friction_angle", 0.4},
                         {"peak_strain", 0.01},
                         {"residual_strain", 0.1}});
    add("drucker_prager", {{"youngs_modulus", young},
                           {"poisson_ratio", 0.3},
                           {"cohesion", 1e3},
                           {"friction_angle", 0.5},
                           {"dilation_angle", 0.1}});
    add("residual_strength", {{"youngs_modulus", young},
                              {"poisson_ratio", 0.49},
                              {"strength", 4e3},
                              {"soft_strength", 2e3},
                              {"residual_strain", 0.5}});
    add("mu_i", {{"youngs_modulus", young},
                 {"poisson_ratio", 0.3},
                 {"mu_static", 0.38},
                 {"mu_limit", 0.64},
                 {"inertial_number", 0.28},
                 {"grain_size", 5e-3},
                 {"grain_density", 2500.0}});
    add("newtonian_fluid", {{"bulk_modulus", young}, {"viscosity", 50.0}, {"eos_exponent", 7.0}});
    add("bingham", {{"bulk_modulus", young}, {"viscosity", 50.0}, {"yield_stress", 200.0}});
    add("herschel_bulkley", {{"bulk_modulus", young},
                             {"consistency", 80.0},
                             {"flow_index", 0.5},
                             {"yield_stress", 200.0}});
    add("modified_cam_clay", {{"critical_ratio", 1.2},
                              {"compression_index", 0.1},
                              {"swelling_index", 0.02},
                              {"poisson_ratio", 0.3},
                              {"preconsolidation", 5e4},
                              {"reference_pressure", 1e5},
                              {"minimum_pressure", 1e3}});
    return m;
  }();
  return all;
}

/// A block 6 m long and 3 m high, its points shaken off their lattice, under its weight.
ParticleSet block(const MaterialSpec& material) {
  constexpr double kDensity = 1800.0, kHeight = 3.0;
  ParticleSet p;
  p.materials = {material};
  add_lattice(p, {0.0, 0.0, 6.0, kHeight}, 0.25, kDensity);
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> jitter(-0.05, 0.05);
  for (std::size_t q = 0; q < p.size(); ++q) {
    for (int d = 0; d < 2; ++d) p.position[q][d] += jitter(random);
    const double vertical = -kDensity * 9.81 * (kHeight + 0.2 - p.position[q][1]);
    p.stress[q] = {0.6 * vertical, vertical, 0.6 * vertical, 0.0, 0.0, 0.0};
  }
  return p;
}

FlowConfig settings() {
  FlowConfig c;
  c.cell = 0.5;
  c.transfer = Transfer::apic;
  c.end = 10.0;
  c.ground.surface = {{-10.0, 0.0}, {8.0, 0.0}, {20.0, -3.0}};
  c.ground.friction = 0.4;
  c.left_roller = 0.0;
  c.softening.reference_length = 1.25;
  return c;
}

template <int Dim>
std::string digest(const ParticleSet& p, const FlowConfig& c, int threads, int steps) {
  Simulation<Dim> s = make_simulation<Dim>(p, c);
  StepScratch<Dim> scratch(threads);
  prepare(s, scratch, true);
  const Reference<Dim> start{sum_points(s), 6.0};
  for (int i = 0; i < steps; ++i) advance(s, scratch);
  Digest d;
  visit_arrays(s.points, [&](auto& array) {
    for (const auto x : array) d.add(x);
  });
  std::vector<Place> buffer;
  const MpmSample r = sample(s, start, std::vector<bool>(s.materials.size(), true), buffer);
  for (const double x : {r.time, r.runout, r.front, r.kinetic, r.gravity_work, r.strain_energy,
                         r.plastic_work, r.friction_work, r.damping_work, r.max_speed, r.dt})
    d.add(x);
  return d.text();
}

}  // namespace

Lines laws(int threads) {
  Lines lines;
  for (const MaterialSpec& m : materials()) {
    lines.push_back({"law/" + m.law + "/2D", digest<2>(block(m), settings(), threads, 300)});
    FlowConfig c = settings();
    c.extrude.emplace();
    c.extrude->width = 1.5;
    c.side_rollers = {{0.0, 1.5}};
    lines.push_back({"law/" + m.law + "/3D", digest<3>(extrude(block(m), 1.5), c, threads, 60)});
  }
  return lines;
}

Lines schemes(int threads) {
  Lines lines;
  const ParticleSet p = block(materials()[2]);
  const auto add = [&](const std::string& name, auto&& change) {
    FlowConfig c = settings();
    change(c);
    lines.push_back({"scheme/" + name, digest<2>(p, c, threads, 200)});
  };
  const std::pair<std::string, BasisKind> bases[] = {{"linear", BasisKind::linear},
                                                     {"gimp", BasisKind::gimp},
                                                     {"quadratic", BasisKind::quadratic},
                                                     {"cubic", BasisKind::cubic},
                                                     {"mls", BasisKind::mls}};
  const std::pair<std::string, Transfer> transfers[] = {
      {"apic", Transfer::apic}, {"tpic", Transfer::tpic}, {"aflip", Transfer::aflip},
      {"flip", Transfer::flip}, {"pic", Transfer::pic},   {"fmpm", Transfer::fmpm}};
  for (const auto& [basis_name, basis] : bases)
    for (const auto& [transfer_name, transfer] : transfers)
      add(basis_name + "/" + transfer_name, [kind = basis, way = transfer](FlowConfig& c) {
        c.basis = kind;
        c.transfer = way;
        // No step is safe with hat functions (docs/theory/time-step.md); this one lasts.
        if (kind == BasisKind::linear) c.courant = 0.5;
      });
  add("usf", [](FlowConfig& c) { c.update = Update::usf; });
  add("musl", [](FlowConfig& c) { c.update = Update::musl; });
  add("load", [](FlowConfig& c) { c.tractions = {{{1.0, 3.0}, {5.0, 3.0}, 5e3}}; });
  add("sleep", [](FlowConfig& c) {
    c.sleep.emplace();
    c.sleep->speed = 0.2;
    c.sleep->after = 0.1;
    c.damping = 0.3;
  });
  return lines;
}

}  // namespace flowslide::same_bits
