#include "transfer/sordo2024/compat_sordo2024.hpp"

namespace flowslide {

std::vector<std::string> sordo2024_defects() {
  return {
      "S01 sigma_zz is zero: a Mohr-Coulomb law sees a false stress difference of up to the whole "
      "overburden and returns the stress of most points in the first step",
      "S02 svars_0 holds tan(phi) where CB-Geo reads phi in radians: 35 deg acts as 40.1 deg and "
      "30 "
      "deg as 33.1 deg until softening recomputes it",
      "S03 svars_1, the dilation angle, is zero whatever the material's own",
      "S04 the water-table test compares y with a multiple of y instead of x: embankment counts as "
      "saturated below one level (14.14 m at Mochikoshi), not below the water table",
      "S05 eps_q leaves out e_33 = -eps_v/3 of the strain deviator: too small where the volume "
      "changes",
      "S06 the total strain, gravity included, is handed over as accumulated plastic strain: soil "
      "softens that never yielded, and reversed straining is forgotten",
      "S07 eps_q subtracts the area change of the element from interpolated small strains: two "
      "measures of strain in one deviator",
      "S08 r_u of a node divides by sigma'_v0 of the element that is being read, without a floor: "
      "one node has several values, large and meaningless near a free surface",
      "S09 the strength layer follows the element's sigma'_v0, not the point's: strength jumps "
      "from "
      "element to element",
      "S10 a point at exactly the last limit of the layers (300 kPa) gets no material in the "
      "script; here it is an error",
      "S11 the liquefied area below the r_u limit is a line read by hand for each transfer time: "
      "not repeatable, and liquefied points below it are islands",
      "S12 the line and the water table are tested at positions that still contain the base "
      "movement, the truncation at positions without it",
      "S13 only the x displacement of the base is removed: velocities stay absolute, so the mass "
      "drifts with the base velocity of the transfer time",
      "S14 stress and strain are interpolated by one multiquadric over all materials and the "
      "free-field columns: jumps at interfaces are smeared, free surfaces carry shear and tension",
      "S15 each point gets a quarter of its element's area: wrong for elements that are not "
      "parallelograms, and the mass centre moves",
      "S16 Gauss points and pi are cut to 0.57735 and 3.14159: relative errors of 5e-7 and 8e-7",
      "S17 the gravity state is transferred on the undeformed mesh, later states with all "
      "displacement in the recorders: positions differ by the settlement under gravity; the script "
      "also mixes the first gravity row (stress) with the last (pore pressure), here both are the "
      "last",
      "S18 total stress goes to a one-phase law and the pore pressure is lost: friction acts on "
      "total stress",
      "S19 nsize is sqrt(volume), a length, where CB-Geo keeps the natural size 2/sqrt(points per "
      "cell): matters for GIMP shape functions",
      "S20 unliquefied tailings soften from phi 30 deg, c 1 kPa to phi 0, c 5 kPa: their cohesion "
      "rises with strain",
  };
}

}  // namespace flowslide
