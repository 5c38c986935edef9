#pragma once
#include "core/voigt.hpp"

#include <algorithm>
#include <concepts>

/// A stress that comes from another model, brought back to what a law can carry.
/// docs/theory/transfer.md, "Return to the yield surface"
namespace flowslide {

/// What liquefied soil keeps of a stress that is brought back. Other laws have their own way.
enum class LiquefiedReturn { vertical_stress, mean_stress, none };

struct AdmissibleStress {
  Stress<2> stress;     ///< total [Pa]
  double before = 0.0;  ///< f / strength of the stress that was given; positive: outside [-]
  double after = 0.0;   ///< the same of `stress`
};

/// For laws that carry any stress.
inline AdmissibleStress any_stress(const Stress<2>& total) { return {total}; }

/// The stress with its deviator times `scale` at the effective pressure p > 0 in compression, over
/// the pore pressure u [Pa].
inline Stress<2> scaled_deviator(const Stress<2>& total, double scale, double p, double u) {
  const double mean = mean_stress(total);
  Stress<2> r;
  for (int i = 0; i < 3; ++i) r[i] = (total[i] - mean) * scale - p - u;
  r[3] = total[3] * scale;
  return r;
}

/// For laws that limit a measure of shear to `most` at the pressure p, which is the given one or,
/// where that is less, the least that the law has; u is kept [Pa].
inline AdmissibleStress limited_shear(const Stress<2>& total, double u, double shear, double most,
                                      double p) {
  const double strength = std::max(most, 1.0), scale = shear > most ? most / shear : 1.0;
  const double p_given = -(mean_stress(total) + u);
  return {scaled_deviator(total, scale, p, u), std::max(shear - most, p - p_given) / strength,
          (scale * shear - most) / strength};
}

/// For laws of effective stress whose own return at zero strain increment is what they can carry;
/// u is kept, while a step would let it fall where soil opens. `violation` of an effective stress.
template <class M, class Violation>
AdmissibleStress own_return(const typename M::Constants& c, const typename M::State& s,
                            const Stress<2>& total, Violation&& violation) {
  const auto plus_pore_pressure = [&s](Stress<2> stress, double sign) {
    for (int i = 0; i < 3; ++i) stress[i] += sign * s.pore_pressure;
    return stress;
  };
  const Stress<2> effective = plus_pore_pressure(total, 1.0);
  typename M::State dry = s;
  dry.pore_pressure = 0.0;
  const Stress<2> back = M::template update<2>(c, dry, effective, StrainIncrement<2>{}).stress;
  const Stress<2> kept = plus_pore_pressure(back, -1.0);
  return {kept, violation(effective), violation(plus_pore_pressure(kept, 1.0))};
}

/// A law says what it can carry: total stress in and out, in the state in which it takes the stress
/// over. The state does not change: the difference stems from interpolation and from the change of
/// law, not from straining.
template <class M>
concept AdmitsStress = requires(const typename M::Constants& c, const typename M::State& s,
                                const Stress<2>& total, LiquefiedReturn keeps) {
  { M::admissible(c, s, total, keeps) } -> std::same_as<AdmissibleStress>;
};

}  // namespace flowslide
