#include "constitutive/materials.hpp"
#include "core/check.hpp"
#include "workflows/stages/cross_checks.hpp"

#include <functional>

#include <catch2/catch.hpp>
#include <fmt/format.h>

using namespace flowslide;
using Catch::Contains;

namespace {

/// 30 m high, 120 m long, with centres of its elements at three places.
Soil soil() {
  Soil s;
  s.all = s.counted = s.uncut = {.left = 0.0, .right = 120.0, .bottom = 0.0, .top = 30.0};
  s.area = 3600.0;
  s.centres = {{5.0, 5.0}, {60.0, 15.0}, {115.0, 5.0}};
  return s;
}

FlowConfig flow() {
  FlowConfig c;
  c.cell = 1.25;
  c.end = 100.0;
  return c;
}

std::string errors(const Findings& f) { return fmt::format("{}", fmt::join(f.errors, "\n")); }
std::string warnings(const Findings& f) { return fmt::format("{}", fmt::join(f.warnings, "\n")); }

/// What is said of a scheme after a change; before it, nothing.
Findings with(const std::function<void(FlowConfig&)>& change) {
  FlowConfig c = flow();
  Findings control, found;
  check_scheme(c, soil(), control);
  CHECK(errors(control).empty());
  CHECK(warnings(control).empty());
  change(c);
  check_scheme(c, soil(), found);
  return found;
}

std::string warned(const std::function<void(FlowConfig&)>& change) {
  const Findings found = with(change);
  CHECK(errors(found).empty());
  return warnings(found);
}

MapMaterial material(double peak_strain, double residual_strain,
                     std::optional<double> residual_cohesion) {
  MohrCoulomb::Params law;
  law.youngs_modulus = 20e6;
  law.poisson_ratio = 0.3;
  law.cohesion = 25e3;
  law.friction_angle = 0.6;
  law.residual_cohesion = residual_cohesion;
  law.peak_strain = peak_strain;
  law.residual_strain = residual_strain;
  MapMaterial m;
  m.law.of<MohrCoulomb>() = law;
  return m;
}

}  // namespace

TEST_CASE("What holds a flow back or lets it go is seen") {
  CHECK_THAT(warned([](FlowConfig& c) { c.ground.friction = 35.0; }),
             Contains("ground.friction: 35 is more"));
  CHECK_THAT(warned([](FlowConfig& c) { c.ground.friction = 0.0; }), Contains("as if on ice"));
  CHECK_THAT(warned([](FlowConfig& c) { c.damping = 0.1; }), Contains("damping: 0.1 of every"));
  CHECK(warned([](FlowConfig& c) { c.damping = 0.01; }).empty());
  CHECK_THAT(warned([](FlowConfig& c) { c.gravity = 1e4; }), Contains("not that of the earth"));
}

TEST_CASE("Transfers of velocity that lose motion are seen") {
  using mpm::Transfer;
  CHECK_THAT(warned([](FlowConfig& c) { c.transfer = Transfer::pic; }), Contains("transfer: pic"));
  CHECK_THAT(warned([](FlowConfig& c) { c.transfer = Transfer::fmpm; }), Contains("fmpm takes"));
  CHECK(warned([](FlowConfig& c) { c.transfer = Transfer::flip; }).empty());
  const auto flip = [](FlowConfig& c) { c.transfer = Transfer::flip, c.flip_share = 0.5; };
  CHECK_THAT(warned(flip), Contains("flip_share: 0.5 takes"));
  CHECK_THAT(warned([](FlowConfig& c) { c.relaxation = 1e-3; }), Contains("stops early"));
  CHECK_THAT(warned([](FlowConfig& c) { c.relaxation = 1e9; }), Contains("is not damped"));
}

TEST_CASE("A rule of rest that would end a flow early is seen") {
  CHECK_THAT(warned([](FlowConfig& c) { c.end = 4.0; }),
             Contains("end: 4 s is before rest.window"));
  CHECK_THAT(warned([](FlowConfig& c) { c.rest.window = 0.5; }), Contains("hardly begun to fall"));
  CHECK_THAT(warned([](FlowConfig& c) { c.sample_interval = 60.0; }),
             Contains("sample_interval: 60 s is longer than rest.window"));
  CHECK_THAT(warned([](FlowConfig& c) { c.rest.kinetic_share = 0.5; }),
             Contains("0.5 of its largest"));
  CHECK_THAT(warned([](FlowConfig& c) { c.rest.runout_change = 10.0; }),
             Contains("moves by 10 m in 5 s"));
  // Soil with half a hundredth of gravity comes 25 mm in the first second.
  CHECK(
      warned([](FlowConfig& c) { c.sleep = SleepSettings{.speed = 0.02, .after = 1.0}; }).empty());
  CHECK_THAT(warned([](FlowConfig& c) { c.sleep = SleepSettings{.speed = 1.0, .after = 1.0}; }),
             Contains("less than 2 m/s2 is put to sleep"));
}

TEST_CASE("A grid that cannot be numbered is refused before anything runs") {
  CHECK_THAT(errors(with([](FlowConfig& c) {
               c.grid_origin = {1e9, 0.0};
             })),
             Contains("8e+08 cells from the soil"));
  CHECK(errors(with([](FlowConfig& c) { c.grid_origin = {-1e5, 0.0}; })).empty());
}

TEST_CASE("Softening that no slide reaches is seen") {
  MapConfig map;
  map.cell = 1.25;
  const std::vector<HistoryMaterial> soils{{"dam", 1, 1900.0}};
  const auto strains = [&](double peak, double residual, std::optional<double> cohesion) {
    map.materials = {{"dam", material(peak, residual, cohesion)}};
    Findings found;
    check_map_materials(map, soils, soil(), found);
    CHECK(errors(found).empty());
    return warnings(found);
  };
  CHECK(strains(0.01, 0.05, 1e3).empty());
  CHECK(strains(0.0, 0.0, std::nullopt).empty());  // nothing that would soften
  CHECK_THAT(strains(0.01, 0.005, 1e3), Contains("0.005 is not above peak_strain"));
  CHECK_THAT(strains(1.0, 50.0, 1e3), Contains("comes after any slide has stopped"));
}

TEST_CASE("A box that cuts the dam is seen, and planes that cut it are refused") {
  MapConfig map;
  map.cell = 1.25;
  const auto cut = [&](double right, double top) {
    Soil s = soil();
    s.counted.right = right;
    s.counted.top = top;
    Findings found;
    check_box(map, s, found);
    return warnings(found);
  };
  CHECK(cut(120.0, 30.0).empty());
  CHECK_THAT(cut(80.0, 30.0), Contains("box.right: x = 80 m cuts") && Contains("x = 120 m"));
  CHECK_THAT(cut(120.0, 20.0), Contains("box.top: y = 20 m cuts") && Contains("10 m higher"));
  const auto planes = [](const AbsorbingSettings& at) {
    FlowConfig c = flow();
    c.absorbing = at;
    Findings found;
    check_edges(c, soil(), found);
    return errors(found);
  };
  CHECK(planes({.left = 0.0, .right = 120.0, .bottom = 0.0}).empty());
  CHECK_THAT(planes({.left = 10.0, .right = {}, .bottom = {}}), Contains("absorbing.left: 10 m"));
  CHECK_THAT(planes({.left = {}, .right = 110.0, .bottom = {}}), Contains("(115, 5) m"));
  CHECK_THAT(planes({.left = {}, .right = {}, .bottom = 10.0}), Contains("absorbing.bottom"));
}

TEST_CASE("A pore pressure that no soil reaches, or any, is seen as the mark of liquefaction") {
  const auto marked = [](double threshold, double floor) {
    RuConfig c;
    c.threshold = threshold;
    c.floor = floor;
    Findings found;
    check_r_u(c, found);
    return warnings(found);
  };
  CHECK(marked(0.7, 8e3).empty());
  CHECK_THAT(marked(1e300, 8e3), Contains("nothing may liquefy"));
  CHECK_THAT(marked(0.01, 8e3), Contains("most of its effective stress"));
  CHECK_THAT(marked(0.7, 1e6), Contains("less than 1000 kPa"));
}

TEST_CASE("Damping and tolerances that hide the shaking are seen") {
  const auto shaken = [](const std::function<void(FemConfig&)>& change) {
    FemConfig c;
    Findings control, found;
    check_fem_soils(c, control);
    CHECK(warnings(control).empty());
    change(c);
    check_fem_soils(c, found);
    return warnings(found);
  };
  CHECK(shaken([](FemConfig& c) { c.damping.ratio = 0.05; }).empty());
  CHECK_THAT(shaken([](FemConfig& c) { c.damping.ratio = 0.5; }), Contains("of critical at 1 Hz"));
  CHECK(shaken([](FemConfig& c) { c.damping.largest_ratio = 1.0; }).empty());
  CHECK_THAT(shaken([](FemConfig& c) { c.damping.largest_ratio = 0.01; }),
             Contains("damping.largest_ratio: 0.01"));
  CHECK_THAT(shaken([](FemConfig& c) { c.damping.mass = 1e3, c.damping.stiffness = 0.0; }),
             Contains("of critical at 1 Hz"));
  const auto loose = [](FemConfig& c) {
    c.integration.scheme = IntegrationScheme::implicit;
    c.integration.tolerance = 1.0;
  };
  CHECK_THAT(shaken(loose), Contains("pass for equilibrium"));
  CHECK_THAT(shaken([](FemConfig& c) { c.stabilisation.hourglass = 0.0; }),
             Contains("hourglass: 0 lets"));
  CHECK_THAT(shaken([](FemConfig& c) { c.stabilisation.pressure = 0.0; }),
             Contains("stabilisation.pressure: 0"));
}
