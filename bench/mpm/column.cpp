#include "bench/mpm/column.hpp"

#include "core/elementary.hpp"
#include "mpm/grid/local_grid.hpp"
#include "mpm/kernels/basis.hpp"

#include <cmath>
#include <random>

namespace flowslide::mpm {
namespace {

constexpr double kCell = 0.5, kSpacing = 0.25, kDensity = 1800.0, kGravity = 9.81;

MaterialSpec bench_material(BenchLaw law) {
  const std::string name(law_name(law));
  switch (law) {
    case BenchLaw::linear_elastic:
      return {name, name, {{"youngs_modulus", 20e6}, {"poisson_ratio", 0.3}}, true};
    case BenchLaw::mohr_coulomb:
      return {name,
              name,
              {{"youngs_modulus", 20e6},
               {"poisson_ratio", 0.3},
               {"cohesion", 5e3},
               {"friction_angle", 0.5},
               {"residual_cohesion", 1e3},
               {"residual_friction_angle", 0.35},
               {"peak_strain", 0.01},
               {"residual_strain", 0.05}},
              true};
    case BenchLaw::residual_strength:
      break;
  }
  return {name,
          name,
          {{"youngs_modulus", 20e6},
           {"poisson_ratio", 0.49},
           {"strength", 20e3},
           {"soft_strength", 10e3}},
          true};
}

}  // namespace

std::string_view law_name(BenchLaw law) {
  static constexpr std::array<std::string_view, 3> names{"linear_elastic", "mohr_coulomb",
                                                         "residual_strength"};
  return names[static_cast<std::size_t>(law)];
}

template <int Dim>
Simulation<Dim> bench_column(int points_per_side, BasisKind basis, BenchLaw law) {
  ParticleSet p;
  p.dim = Dim;
  p.materials = {bench_material(law)};
  const auto side = static_cast<std::size_t>(points_per_side);
  resize(p, Dim == 2 ? side * side : side * side * side);
  p.pore_pressure.assign(p.size(), 0.0);
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> jitter(-0.2 * kSpacing, 0.2 * kSpacing);
  const double height = kSpacing * points_per_side;
  for (std::size_t q = 0, rest = 0; q < p.size(); ++q) {
    rest = q;
    for (int d = 0; d < Dim; ++d, rest /= side)
      p.position[q][d] = kSpacing * (double(rest % side) + 0.5) + jitter(random);
    const double vertical = -kDensity * kGravity * (height - p.position[q][Dim - 1]);
    p.stress[q] = {0.35 * vertical, 0.35 * vertical, 0.35 * vertical, 0.0, 0.0, 0.0};
    p.stress[q][Dim - 1] = vertical;
    p.volume[q] = pow(kSpacing, Dim);
    p.mass[q] = kDensity * p.volume[q];
    p.material[q] = 0;
    p.id[q] = static_cast<std::int64_t>(q) + 1;
  }
  FlowConfig c;
  c.cell = kCell;
  c.end = 1.0;
  c.basis = basis;
  c.transfer = Transfer::apic;  // as bytes_per_update counts
  c.ground.friction = 0.5;
  c.left_roller = 0.0;
  c.softening.reference_length = 1.25;
  return make_simulation<Dim>(p, c);
}

template <int Dim>
double bytes_per_update(const Simulation<Dim>& s, BenchLaw law) {
  const int states = law == BenchLaw::linear_elastic ? 0 : law == BenchLaw::mohr_coulomb ? 3 : 4;
  constexpr int x = Dim, v = Dim, c = Dim * Dim, sigma = kVoigt<Dim>, mass = 1, volume = 1;
  const int loads = x + v + c + sigma + states + mass + volume;
  const int stores = x + v + c + sigma + states + volume;
  const double windows = visit_basis(s.settings.basis, [&]<class Basis>(Basis) {
    return double(s.tiling.tiles.size()) * kWindowNodes<Dim, Basis>;
  });
  const double nodes = double(s.grid.nodes.size());
  return 8.0 * (loads + stores) + 2.0 * sizeof(Node) * (nodes + windows) / double(s.points.size());
}

template Simulation<2> bench_column<2>(int, BasisKind, BenchLaw);
template Simulation<3> bench_column<3>(int, BasisKind, BenchLaw);
template double bytes_per_update<2>(const Simulation<2>&, BenchLaw);
template double bytes_per_update<3>(const Simulation<3>&, BenchLaw);

}  // namespace flowslide::mpm
