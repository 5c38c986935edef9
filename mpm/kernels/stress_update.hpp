#pragma once
#include "constitutive/gap.hpp"
#include "core/pack_pair.hpp"
#include "mpm/kernels/rotation.hpp"
#include "mpm/kernels/stress.hpp"

#include <bit>
#include <cmath>

/// update_stress for every law; included by the files that instantiate it.
namespace flowslide::mpm {

/// What a law runs on at once: a Pack of points; one, if it iterates and says so with `per_point`;
/// two Packs in three dimensions, if it says with `long_chain_3d` that its operations wait for each
/// other.
template <int Dim, class M>
constexpr auto lanes_of() {
  if constexpr (requires { M::per_point; })
    return double{};
  else if constexpr (Dim == 3 && requires { M::long_chain_3d; })
    return PackPair{};
  else
    return Pack{};
}
template <int Dim, class M>
using Lanes = decltype(lanes_of<Dim, M>());

template <int Dim, class M>
[[gnu::flatten]] StressWork update_run(Points<Dim>& p, const Tile<Dim>& tile,
                                       const MaterialRun& run, const SolverMaterial& material,
                                       const typename M::Constants& constants, double dt,
                                       double modulus, const TileScratch<Dim>& s) noexcept {
  using T = Lanes<Dim, M>;
  using State = typename M::template StateOf<T>;
  constexpr int V = kVoigt<Dim>, S = static_cast<int>(M::state_names.size());
  constexpr int width = kLanes<T>;
  StressWork work;
  T wave2 = 0.0, speed2 = 0.0, strain2 = 0.0;
  OrderedSum<T> power_start, power_end;
  for (std::int32_t q = run.first; q < run.last; q += width) {
    const int n = std::min<int>(width, run.last - q);
    const std::int32_t k = q - tile.first;
    const auto read = [&](const auto& array, std::int32_t at) {
      return load_lanes<T>(array.data() + at, n);
    };
    const auto write = [&](auto& array, T value) { store_lanes(array.data() + q, value, n); };
    std::array<T, Dim * Dim> l;
    unroll<Dim * Dim>([&](auto i) { l[i] = read(s.gradient[i], k); });
    Stress<Dim, T> sigma;
    unroll<V>([&](auto i) { sigma[i] = read(p.sigma[i], q); });
    State state{};
    if constexpr (S > 0) {
      std::array<T, S> values;
      unroll<S>([&](auto i) { values[i] = read(p.state[i], q); });
      state = std::bit_cast<State>(values);
    }

    const T shift = read(s.average.change, k) * (dt / 3.0);
    const StrainIncrement<Dim, T> de = strain_increment<Dim>(l, shift, dt);
    const auto result =
        update_law<M, Dim, T>(constants, state, rotate_by_spin<Dim>(sigma, l, dt), de, dt);

    const T volume = read(p.volume, q);
    T work_start = 0.0, work_end = 0.0;
    for (int i = 0; i < V; ++i) {
      work_start += sigma[i] * de[i];
      work_end += result.stress[i] * de[i];
    }
    unroll<V>([&](auto i) { write(p.sigma[i], result.stress[i]); });
    if constexpr (S > 0) {
      const auto values = std::bit_cast<std::array<T, S>>(result.state);
      unroll<S>([&](auto i) { write(p.state[i], values[i]); });
    }
    const T growth = de[0] + de[1] + de[2];
    // exp(growth) to third order: volume stays positive for any compression the step limit allows.
    const T new_volume = volume * (1.0 + growth * (1.0 + growth * (0.5 + growth * (1.0 / 6.0))));
    write(p.volume, new_volume);
    T present = modulus;
    if constexpr (requires { M::template present_modulus<Dim>(constants, result.state, sigma); })
      present = M::template present_modulus<Dim>(constants, result.state, result.stress);
    else if constexpr (requires { result.state.gap; })
      present = modulus_with_gap(modulus, material.elastic.bulk, result.state.gap);
    wave2 = max(wave2, present * new_volume * reciprocal(read(p.mass, q)));
    T v2 = 0.0, l2 = 0.0;
    unroll<Dim>([&](auto d) {
      const T v = read(p.v[d], q);
      v2 += v * v;
    });
    for (int i = 0; i < Dim * Dim; ++i) l2 += l[i] * l[i];
    speed2 = max(speed2, v2);
    strain2 = max(strain2, l2);
    // Lanes beyond n repeat a point.
    const auto counted = first_lanes<T>(n);
    power_start.add(select(counted, volume * work_start, T(0.0)));
    power_end.add(select(counted, new_volume * work_end, T(0.0)));
  }
  work.power_start = power_start.total();
  work.power_end = power_end.total();
  work.max_wave2 = max_lanes(wave2);
  work.max_speed2 = max_lanes(speed2);
  work.max_strain = std::sqrt(max_lanes(strain2)) * dt;
  return work;
}

template <int Dim>
StressWork update_stress(Points<Dim>& p, const Tile<Dim>& tile, std::span<const MaterialRun> runs,
                         std::span<const SolverMaterial> materials, double dt, TileScratch<Dim>& s,
                         bool average) noexcept {
  average_over_spans<Dim>(
      p, tile, runs, s.average,
      [&](const MaterialRun& run) { return average && materials[run.material].average_volume; },
      [&](std::int32_t k, int count) {
        Pack trace = 0.0;
        for (int d = 0; d < Dim; ++d)
          trace += load_pack(s.gradient[(Dim + 1) * d].data() + k, count);
        return trace;
      });
  StressWork total;
  for (const MaterialRun& run : runs) {
    const SolverMaterial& m = materials[run.material];
    const double modulus = wave_modulus(m.elastic, average && m.average_volume);
    total.add(std::visit(
        [&]<class M>(const Typed<M>& law) {
          return update_run<Dim, M>(p, tile, run, m, law.constants, dt, modulus, s);
        },
        m.law));
  }
  return total;
}

}  // namespace flowslide::mpm
