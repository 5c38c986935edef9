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

/// States of `n` points from q on, as a law on T knows them.
template <class M, class T, int Dim>
typename M::template StateOf<T> read_state(const Points<Dim>& p, std::int32_t q, int n) noexcept {
  constexpr int S = static_cast<int>(M::state_names.size());
  typename M::template StateOf<T> state{};
  if constexpr (S > 0) {
    std::array<T, S> values;
    unroll<S>([&](auto i) { values[i] = load_lanes<T>(p.state[i].data() + q, n); });
    state = std::bit_cast<typename M::template StateOf<T>>(values);
  }
  return state;
}
template <class M, class T, int Dim>
void write_state(Points<Dim>& p, std::int32_t q, int n,
                 const typename M::template StateOf<T>& state) noexcept {
  constexpr int S = static_cast<int>(M::state_names.size());
  if constexpr (S > 0) {
    const auto values = std::bit_cast<std::array<T, S>>(state);
    unroll<S>([&](auto i) { store_lanes(p.state[i].data() + q, values[i], n); });
  }
}

/// Wave modulus of a law's result, `elastic` that without strain and gap [Pa].
template <int Dim, class M, class T, class Result>
T present_modulus(const typename M::Constants& constants, const Result& result,
                  double elastic) noexcept {
  if constexpr (requires {
                  M::template present_modulus<Dim>(constants, result.state, result.stress);
                })
    return M::template present_modulus<Dim>(constants, result.state, result.stress);
  else if constexpr (requires { result.state.gap; })
    return modulus_with_gap(elastic, result.state.gap);
  else
    return elastic;
}

/// exp(growth) to third order: volume stays positive for any compression the step limit allows.
template <class T>
T grown(T volume, T growth) noexcept {
  return volume * (1.0 + growth * (1.0 + growth * (0.5 + growth * (1.0 / 6.0))));
}

/// What a run of points adds to the work, lane by lane.
template <class T>
struct RunSums {
  T wave2 = 0.0, speed2 = 0.0, strain2 = 0.0;
  OrderedSum<T> power_start, power_end;

  [[nodiscard]] StressWork total(double dt) const noexcept {
    StressWork work;
    work.power_start = power_start.total();
    work.power_end = power_end.total();
    work.max_wave2 = max_lanes(wave2);
    work.max_speed2 = max_lanes(speed2);
    work.max_strain = std::sqrt(max_lanes(strain2)) * dt;
    return work;
  }
};

template <int Dim, class M>
[[gnu::flatten]] StressWork update_run(Points<Dim>& p, const Tile<Dim>& tile,
                                       const MaterialRun& run,
                                       const typename M::Constants& constants, double dt,
                                       double modulus, const TileScratch<Dim>& s) noexcept {
  using T = Lanes<Dim, M>;
  constexpr int V = kVoigt<Dim>;
  constexpr int width = kLanes<T>;
  RunSums<T> sums;
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

    const T shift = read(s.average.change, k) * (dt / 3.0);
    const StrainIncrement<Dim, T> de = strain_increment<Dim>(l, shift, dt);
    const auto result = update_law<M, Dim, T>(constants, read_state<M, T>(p, q, n),
                                              rotate_by_spin<Dim>(sigma, l, dt), de, dt);

    const T volume = read(p.volume, q);
    T work_start = 0.0, work_end = 0.0;
    for (int i = 0; i < V; ++i) {
      work_start += sigma[i] * de[i];
      work_end += result.stress[i] * de[i];
    }
    unroll<V>([&](auto i) { write(p.sigma[i], result.stress[i]); });
    write_state<M, T>(p, q, n, result.state);
    const T new_volume = grown(volume, de[0] + de[1] + de[2]);
    write(p.volume, new_volume);
    const T present = present_modulus<Dim, M, T>(constants, result, modulus);
    sums.wave2 = max(sums.wave2, present * new_volume * reciprocal(read(p.mass, q)));
    T v2 = 0.0, l2 = 0.0;
    unroll<Dim>([&](auto d) {
      const T v = read(p.v[d], q);
      v2 += v * v;
    });
    for (int i = 0; i < Dim * Dim; ++i) l2 += l[i] * l[i];
    sums.speed2 = max(sums.speed2, v2);
    sums.strain2 = max(sums.strain2, l2);
    // Lanes beyond n repeat a point.
    const auto counted = first_lanes<T>(n);
    sums.power_start.add(select(counted, volume * work_start, T(0.0)));
    sums.power_end.add(select(counted, new_volume * work_end, T(0.0)));
  }
  return sums.total(dt);
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
    total.add(std::visit(
        [&]<class M>(const Typed<M>& law) {
          return update_run<Dim, M>(p, tile, run, law.constants, dt, m.wave_modulus, s);
        },
        m.law));
  }
  return total;
}

}  // namespace flowslide::mpm
