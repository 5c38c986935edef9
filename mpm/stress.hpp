#pragma once
#include "constitutive/materials.hpp"
#include "mpm/g2p.hpp"
#include "mpm/rotation.hpp"

#include <bit>
#include <cmath>
#include <span>
#include <variant>

/// Stress update of the points from their velocity gradients: corotational, with the volumetric
/// rate averaged over knot spans where a material is nearly incompressible (F-bar on rates).
namespace flowslide::mpm {

/// A law with its constants, as the step loop sees it.
template <class M>
struct Typed {
  typename M::Constants constants;
};
using TypedMaterial =
    std::variant<Typed<LinearElastic>, Typed<MohrCoulomb>, Typed<ResidualStrength>>;

struct SolverMaterial {
  TypedMaterial law;
  Elasticity elastic;   ///< for the stable step and the recoverable energy
  bool average_volume;  ///< F-bar: bulk modulus well above shear modulus
};

struct StressWork {
  double power_start = 0.0;  ///< dt sum V sigma : D with V and sigma before the step [J]
  double power_end = 0.0;    ///< the same with V and sigma after it [J]
  double max_wave2 = 0.0;     ///< largest (K + 2 G) / rho [m2/s2]
  double max_speed2 = 0.0;    ///< largest |v|^2 [m2/s2]
  double max_strain = 0.0;    ///< largest |L| dt of the step [-]
  void add(const StressWork& o) {
    power_start += o.power_start;
    power_end += o.power_end;
    max_wave2 = std::max(max_wave2, o.max_wave2);
    max_speed2 = std::max(max_speed2, o.max_speed2);
    max_strain = std::max(max_strain, o.max_strain);
  }
};

template <int Dim, class M>
StressWork update_run(Points<Dim>& p, const Tile<Dim>& tile, const MaterialRun& run,
                      const SolverMaterial& material, const typename M::Constants& constants,
                      double dt, const TileScratch<Dim>& s) noexcept {
  constexpr int V = kVoigt<Dim>, S = static_cast<int>(M::state_names.size());
  const double modulus = material.elastic.bulk + 2.0 * material.elastic.shear;
  double power_start = 0.0, power_end = 0.0, wave2 = 0.0, speed2 = 0.0, strain2 = 0.0;
#pragma omp simd reduction(+ : power_start, power_end) reduction(max : wave2, speed2, strain2)
  for (std::int32_t q = run.first; q < run.last; ++q) {
    const std::int32_t k = q - tile.first;
    double l[Dim * Dim];
    for (int i = 0; i < Dim * Dim; ++i) l[i] = s.gradient[i][k];
    Stress<Dim> sigma;
    for (int i = 0; i < V; ++i) sigma[i] = p.sigma[i][q];
    std::array<double, S> values{};
    for (int i = 0; i < S; ++i) values[i] = p.state[i][q];
    typename M::State state{};
    if constexpr (S > 0) state = std::bit_cast<typename M::State>(values);

    StrainIncrement<Dim> de;
    const double shift = s.average.change[k] / 3.0 * dt;
    Stress<Dim> rotated;
    if constexpr (Dim == 2) {
      de[0] = l[0] * dt + shift;
      de[1] = l[3] * dt + shift;
      de[2] = shift;
      de[3] = (l[1] + l[2]) * dt;
      rotated = rotate(sigma, 0.5 * (l[2] - l[1]) * dt);
    } else {
      de[0] = l[0] * dt + shift;
      de[1] = l[4] * dt + shift;
      de[2] = l[8] * dt + shift;
      de[3] = (l[1] + l[3]) * dt;
      de[4] = (l[5] + l[7]) * dt;
      de[5] = (l[2] + l[6]) * dt;
      rotated = rotate(
          sigma, {0.5 * (l[3] - l[1]) * dt, 0.5 * (l[7] - l[5]) * dt, 0.5 * (l[2] - l[6]) * dt});
    }
    const auto result = M::template update<Dim>(constants, state, rotated, de);

    const double volume = p.volume[q];
    double work_start = 0.0, work_end = 0.0;
    for (int i = 0; i < V; ++i) {
      work_start += sigma[i] * de[i];
      work_end += result.stress[i] * de[i];
    }
    for (int i = 0; i < V; ++i) p.sigma[i][q] = result.stress[i];
    if constexpr (S > 0) {
      values = std::bit_cast<std::array<double, S>>(result.state);
      for (int i = 0; i < S; ++i) p.state[i][q] = values[i];
    }
    const double growth = de[0] + de[1] + de[2];
    // exp(growth) to third order: volume stays positive for any compression the step limit allows.
    const double new_volume = volume * (1.0 + growth * (1.0 + growth * (0.5 + growth / 6.0)));
    p.volume[q] = new_volume;
    power_start += volume * work_start;
    power_end += new_volume * work_end;
    wave2 = std::max(wave2, modulus * new_volume / p.mass[q]);
    double v2 = 0.0, l2 = 0.0;
    for (int d = 0; d < Dim; ++d) v2 += p.v[d][q] * p.v[d][q];
    for (int i = 0; i < Dim * Dim; ++i) l2 += l[i] * l[i];
    speed2 = std::max(speed2, v2);
    strain2 = std::max(strain2, l2);
  }
  return {power_start, power_end, wave2, speed2, std::sqrt(strain2) * dt};
}

template <int Dim>
StressWork update_stress(Points<Dim>& p, const Tile<Dim>& tile, std::span<const MaterialRun> runs,
                         std::span<const SolverMaterial> materials, double dt, TileScratch<Dim>& s,
                         bool average) noexcept {
  average_over_spans<Dim>(
      p, tile, runs, s.average,
      [&](const MaterialRun& run) { return average && materials[run.material].average_volume; },
      [&](std::int32_t k) {
        double trace = 0.0;
        for (int d = 0; d < Dim; ++d) trace += s.gradient[(Dim + 1) * d][k];
        return trace;
      });
  StressWork total;
  for (const MaterialRun& run : runs) {
    const SolverMaterial& m = materials[run.material];
    total.add(std::visit(
        [&]<class M>(const Typed<M>& law) {
          return update_run<Dim, M>(p, tile, run, m, law.constants, dt, s);
        },
        m.law));
  }
  return total;
}

}  // namespace flowslide::mpm
