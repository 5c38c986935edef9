#include "verify/section/cases.hpp"

#include "verify/section/list.hpp"

namespace flowslide {

std::vector<VerificationCase> section_cases() {
  using namespace section;
  return {
      {"section/fredlund_krahn", "one circle by three methods, against Fredlund & Krahn (1977)",
       true, verify_fredlund_krahn},
      {"section/taylor", "critical circles in undrained clay, against Taylor's stability numbers",
       true, verify_taylor},
      {"section/griffiths_lane",
       "critical circle in c-phi soil, against Bishop & Morgenstern (1960)", true,
       verify_griffiths_lane},
      {"section/mochikoshi", "Mochikoshi dam against depth of liquefaction", false,
       verify_mochikoshi},
  };
}

}  // namespace flowslide
