#include "workflows/stages/cross_checks.hpp"

#include <catch2/catch.hpp>

using namespace flowslide;
using Catch::Contains;

namespace {

/// What is said of settings after a change; with the setting that they belong to, nothing.
template <class Config, class Change, class Needed>
void idle_until(Change change, Needed needed, const char* said) {
  Config c;
  Findings usual, idle, acting;
  check_inert(c, usual);
  CHECK(usual.warnings.empty());
  change(c);
  check_inert(c, idle);
  REQUIRE(idle.warnings.size() == 1);
  CHECK_THAT(idle.warnings[0], Contains(said));
  needed(c);
  check_inert(c, acting);
  CHECK(acting.warnings.empty());
}

}  // namespace

TEST_CASE("Settings of another transfer of velocity are told") {
  using mpm::Transfer;
  const auto take = [](Transfer t) { return [t](FlowConfig& c) { c.transfer = t; }; };
  idle_until<FlowConfig>([](FlowConfig& c) { c.flip_share = 0.5; }, take(Transfer::flip),
                         "flip_share: has no effect here: for transfer: flip only.");
  idle_until<FlowConfig>([](FlowConfig& c) { c.fmpm_order = 3; }, take(Transfer::fmpm),
                         "fmpm_order: has no effect");
  idle_until<FlowConfig>([](FlowConfig& c) { c.transfer = Transfer::apic, c.relaxation = 1.0; },
                         take(Transfer::aflip), "relaxation: has no effect");
}

TEST_CASE("Settings that a shaking does not look at are told") {
  const auto without_factors = [](FemConfig& c) { c.damping.mass = c.damping.stiffness = {}; };
  const auto columns = [](FemConfig& c) { c.sides.kind = SideKind::free_field; };
  idle_until<FemConfig>(
      [](FemConfig& c) { c.damping.mass = 0.1, c.damping.stiffness = 1e-3, c.damping.ratio = 0.1; },
      without_factors, "damping.ratio: has no effect");
  idle_until<FemConfig>(
      [](FemConfig& c) {
        c.damping.mass = 0.1, c.damping.stiffness = 1e-3, c.damping.frequencies = {1.0, 5.0};
      },
      without_factors, "damping.frequencies: has no effect");
  idle_until<FemConfig>([](FemConfig& c) { c.sides.kind = SideKind::tied, c.sides.width = 5.0; },
                        columns, "sides.width: has no effect");
  idle_until<FemConfig>(
      [](FemConfig& c) { c.sides.kind = SideKind::fixed, c.sides.thickness = 50.0; }, columns,
      "sides.thickness: has no effect");
  idle_until<FemConfig>([](FemConfig& c) { c.integration.theta = 1.0; },
                        [](FemConfig& c) { c.integration.scheme = IntegrationScheme::implicit; },
                        "integration: has no effect");
  idle_until<FemConfig>(
      [](FemConfig& c) { c.integration.scheme = IntegrationScheme::implicit, c.courant = 0.9; },
      [](FemConfig& c) { c.integration.scheme = IntegrationScheme::explicit_steps; },
      "courant: has no effect");
}
