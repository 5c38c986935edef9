#include "verify/mpm/cases.hpp"

#include "verify/mpm/list.hpp"

namespace flowslide {

std::vector<VerificationCase> mpm_cases() {
  using namespace mpm;
  return {
      {"mpm/v1_compaction", "column under its own weight, against equilibrium", false,
       verify_compaction},
      {"mpm/v1_mirror", "the same on its mirror image in place of the ground", true, verify_mirror},
      {"mpm/v2_bar", "period and energy of a swinging bar, against its first mode", false,
       verify_bar},
      {"mpm/v3_wave", "manufactured wave, periodic and between walls", false, verify_wave},
      {"mpm/v5_vortex", "manufactured ring that turns and returns", false, verify_vortex},
      {"mpm/v7_cantilever", "large bending under gravity, against finite elements", false,
       verify_cantilever},
      {"mpm/v8_incline", "block on a frictional incline at four angles to the grid", false,
       verify_incline},
      {"mpm/v8_terrain", "the same block on a height field that rises in any direction", false,
       verify_terrain},
      {"mpm/v10_infinite_slope", "layer that slides on an incline, against statics", false,
       verify_infinite_slope},
      {"mpm/v11_sheet_flow", "steady flow of fluids down an incline", false, verify_sheet_flow},
      {"mpm/v13_impact", "two elastic discs collide: momentum and energy", true, verify_impact},
      {"mpm/v14_rotation", "a full rigid turn: angular momentum and carried stress", true,
       verify_rotation},
      {"mpm/v15_rest", "hydrostatic column over 1e5 steps", false, verify_rest},
      {"mpm/bui_column", "granular column of aluminium bars, against the experiment", false,
       verify_bui},
      {"mpm/columns_short", "a dry column in the plane, against experiments and its control", true,
       verify_columns_short},
      {"mpm/columns_plane", "dry columns of four aspect ratios in the plane, against experiments",
       false, verify_columns_plane},
      {"mpm/columns_channel", "glass beads between rough walls, against the experiment", false,
       verify_columns_channel},
      {"mpm/columns_round", "round columns in three dimensions, against the experiment", false,
       verify_columns_round},
      {"mpm/undrained_column", "reach of undrained columns, between two bounds", false,
       verify_undrained},
      {"mpm/vertical_cut", "strength at which an undrained vertical cut stands", false, verify_cut},
      {"mpm/prandtl_tresca", "strip load on undrained clay, against Prandtl", false,
       verify_prandtl},
      {"mpm/prandtl_mohr_coulomb", "the same on soil with friction", false, verify_prandtl_mc},
      {"mpm/griffiths_lane", "factor of safety of a 2:1 slope", false, verify_slope},
      {"mpm/valley", "the dam in three dimensions between smooth walls, against plane strain",
       false, verify_valley},
      {"mpm/hard_crossing", "stress of a body that crosses cells", false, verify_crossing},
      {"mpm/hard_ringing", "point modes the grid cannot see, and a million steps", false,
       verify_ringing},
      {"mpm/hard_sparse", "stability of points at random places", true, verify_sparse},
      {"mpm/hard_stretch", "a bar pulled to four times its length", false, verify_stretch},
      {"mpm/hard_rejoin", "soil torn apart and closed again", true, verify_rejoin},
      {"mpm/hard_weak", "collapse with a strength of 100 Pa and 1 Pa", true, verify_weak},
      {"mpm/hard_contrast", "layers a thousand times stiffer than others", true, verify_contrast},
      {"mpm/hard_impact", "a soft block hits the ground", true, verify_hit},
      {"mpm/hard_corner", "a block falls into a notch of two rough walls", true, verify_corner},
      {"mpm/hard_locking", "bending of soil that keeps its volume", false, verify_locking},
      {"mpm/hard_leaving", "points that leave by an outlet, fly apart, or leave the grid", true,
       verify_leaving},
      {"mpm/extremes", "settings at random over twenty decades: every run ends by itself", false,
       verify_extremes},
      {"mpm/return_maps", "a million random states through every law", false, verify_return_maps},
  };
}

}  // namespace flowslide
