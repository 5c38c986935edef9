#include "mpm/verify/cases.hpp"

#include "mpm/verify/list.hpp"

namespace flowslide {

std::vector<VerificationCase> mpm_cases() {
  using namespace mpm;
  return {
      {"mpm/v1_compaction", "column under its own weight, against equilibrium", false,
       verify_compaction},
      {"mpm/v1_mirror", "the same on its mirror image in place of the ground", true, verify_mirror},
  };
}

}  // namespace flowslide
