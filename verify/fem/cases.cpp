#include "verify/fem/cases.hpp"

#include "verify/fem/list.hpp"

namespace flowslide {

std::vector<VerificationCase> fem_cases() {
  using namespace fem;
  return {
      {"fem/f1_patch", "constant states on distorted elements", true, verify_patch},
      {"fem/f2_terzaghi", "consolidation in one dimension, against the series", false,
       verify_terzaghi},
      {"fem/f2_first_step", "pore pressure at a drained surface just after loading", true,
       verify_first_step},
      {"fem/f3_mandel", "consolidation between plates, against the series", false, verify_mandel},
      {"fem/f4_cryer", "consolidation of a cylinder under pressure, against the series", true,
       verify_cylinder},
      {"fem/f5_harmonic", "vibrated saturated column, against the u-p equations", false,
       verify_harmonic_column},
      {"fem/f6_site_response", "damped layer on elastic rock, against its transfer function", true,
       verify_site_response},
      {"fem/f6_reflection", "what a compliant base gives back of a wave", true, verify_reflection},
      {"fem/f7_undrained", "pore pressure under a footing on undrained soil", true,
       verify_undrained},
      {"fem/f8_cyclic", "cyclic strength of PM4Sand at 15 cycles, against the manual", false,
       verify_cyclic_strength},
      {"fem/f8_strength", "undrained strength of the tailings, against OpenSees", true,
       verify_undrained_strength},
      {"fem/f9_steps", "sand column: smaller steps and strain increments", true,
       verify_pm4sand_step},
      {"fem/f9_implicit", "sand column: implicit integration with an assembly of its own", true,
       verify_implicit},
      {"fem/f9_slope", "slope of sand: explicit against implicit steps, until it liquefies", true,
       verify_implicit_slope},
      {"fem/f9_length", "slope of sand that softens: three sizes of elements, with a length", false,
       verify_softening_length},
      {"fem/f10_velacs", "level and inclined sand on the centrifuge", false, verify_centrifuge},
      {"fem/c2_rest", "a slope of sand at rest for 10 s", true, verify_rest},
      {"fem/c2_bending", "cantilever, against the beam", true, verify_bending},
      {"fem/c2_hinge", "cantilever of weak soil, against its plastic moment", true, verify_hinge},
      {"fem/c2_hostile", "100 random sections and motions end well or with a cause", false,
       verify_hostile},
  };
}

}  // namespace flowslide
