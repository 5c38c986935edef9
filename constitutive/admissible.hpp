#pragma once
#include "core/voigt.hpp"

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

/// A law says what it can carry: total stress in and out, in the state in which it takes the stress
/// over. The state does not change: the difference stems from interpolation and from the change of
/// law, not from straining.
template <class M>
concept AdmitsStress = requires(const typename M::Constants& c, const typename M::State& s,
                                const Stress<2>& total, LiquefiedReturn keeps) {
  { M::admissible(c, s, total, keeps) } -> std::same_as<AdmissibleStress>;
};

}  // namespace flowslide
