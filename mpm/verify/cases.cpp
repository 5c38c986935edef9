#include "mpm/verify/cases.hpp"

#include "mpm/verify/list.hpp"

namespace flowslide {

std::vector<VerificationCase> mpm_cases() {
  using namespace mpm;
  return {
      {"mpm/v1_compaction", "column under its own weight, against equilibrium", false,
       verify_compaction},
      {"mpm/v1_mirror", "the same on its mirror image in place of the ground", true, verify_mirror},
      {"mpm/v2_bar", "period and energy of a swinging bar, against its first mode", false,
       verify_bar},
      {"mpm/v7_cantilever", "large bending under gravity, against finite elements", false,
       verify_cantilever},
      {"mpm/v8_incline", "block on a frictional incline at four angles to the grid", false,
       verify_incline},
      {"mpm/v13_impact", "two elastic discs collide: momentum and energy", true, verify_impact},
      {"mpm/v14_rotation", "a full rigid turn: angular momentum and carried stress", true,
       verify_rotation},
      {"mpm/v15_rest", "hydrostatic column over 1e5 steps", false, verify_rest},
      {"mpm/bui_column", "granular column of aluminium bars, against the experiment", false,
       verify_bui},
      {"mpm/undrained_column", "reach of undrained columns, between two bounds", false,
       verify_undrained},
      {"mpm/vertical_cut", "strength at which an undrained vertical cut stands", true, verify_cut},
      {"mpm/prandtl_tresca", "strip load on undrained clay, against Prandtl", false,
       verify_prandtl},
      {"mpm/prandtl_mohr_coulomb", "the same on soil with friction", true, verify_prandtl_mc},
      {"mpm/griffiths_lane", "factor of safety of a 2:1 slope", false, verify_slope},
  };
}

}  // namespace flowslide
