#include "constitutive/materials.hpp"
#include "core/check.hpp"
#include "workflows/stages/cross_checks.hpp"

#include <functional>

#include <catch2/catch.hpp>
#include <fmt/format.h>

/// Choices that shorten a runout, or leave it to the cells.
using namespace flowslide;
using Catch::Contains;

namespace {

/// 32 m high and 120 m long, in elements of 2 m.
Soil soil() {
  Soil s;
  s.all = s.counted = s.uncut = {.left = 0.0, .right = 120.0, .bottom = 0.0, .top = 32.0};
  s.area = 3840.0;
  s.largest = 4.0;
  s.centres = {{5.0, 5.0}, {60.0, 15.0}, {115.0, 5.0}};
  return s;
}

FlowConfig flow(double cell) {
  FlowConfig c;
  c.cell = cell;
  c.end = 100.0;
  return c;
}

std::string errors(const Findings& f) { return fmt::format("{}", fmt::join(f.errors, "\n")); }
std::string warnings(const Findings& f) { return fmt::format("{}", fmt::join(f.warnings, "\n")); }

MapMaterial softening_soil() {
  MohrCoulomb::Params law;
  law.youngs_modulus = 20e6;
  law.poisson_ratio = 0.3;
  law.cohesion = 25e3;
  law.friction_angle = 0.6;
  law.residual_cohesion = 1e3;
  law.peak_strain = 0.01;
  law.residual_strain = 0.05;
  MapMaterial m;
  m.law.of<MohrCoulomb>() = law;
  return m;
}

}  // namespace

TEST_CASE("A transfer whose viscosity grows with the cell is seen where cells are coarse") {
  const auto with = [](mpm::Transfer transfer, double cell) {
    FlowConfig c = flow(cell);
    c.transfer = transfer;
    Findings found;
    check_scheme(c, soil(), found);
    CHECK(found.errors.empty());
    return warnings(found);
  };
  CHECK(with(mpm::Transfer::apic, 1.0).empty());
  CHECK(with(mpm::Transfer::aflip, 2.0).empty());
  CHECK_THAT(with(mpm::Transfer::apic, 2.0), Contains("transfer: apic") && Contains("16 cells"));
  CHECK_THAT(with(mpm::Transfer::tpic, 2.0), Contains("transfer: tpic") && Contains("of 1 m"));
}

TEST_CASE("Softening has a length where soil softens") {
  MapConfig map;
  map.cell = 1.25;
  const auto asked = [&](const std::function<void(SofteningSettings&)>& change) {
    FlowConfig c = flow(1.25);
    change(c.softening);
    Findings found;
    check_softening(c, map, soil(), found);
    return found;
  };
  const auto none = [](SofteningSettings&) {};
  const auto at = [](double length) {
    return [length](SofteningSettings& s) { s.reference_length = length; };
  };
  map.materials = {{"dam", softening_soil()}};
  CHECK_THAT(errors(asked(none)), Contains("'dam' softens") && Contains("1.25 m"));
  CHECK(errors(asked(at(1.25))).empty());
  CHECK(warnings(asked(at(1.25))).empty());
  CHECK_THAT(warnings(asked(at(100.0))), Contains("stretched by 80"));
  CHECK_THAT(warnings(asked(at(0.0125))), Contains("0.01 of a cell"));
  const Findings off = asked([](SofteningSettings& s) { s.regularise = false; });
  CHECK(errors(off).empty());
  CHECK_THAT(warnings(off), Contains("regularise: false") && Contains("'dam' softens"));
  // Nothing softens: nothing is asked.
  map.materials["dam"].law.of<MohrCoulomb>()->residual_strain = 0.01;
  CHECK(errors(asked(none)).empty());
  map.materials["dam"].liquefied.emplace();
  map.materials["dam"].liquefied->residual_strain = 1.0;
  map.c_soft_ratio = 1.0;
  CHECK(errors(asked(none)).empty());
  map.c_soft_ratio = 0.5;
  CHECK_THAT(errors(asked(none)), Contains("'dam' softens"));
}

TEST_CASE("Limits of balances are not raised in silence") {
  const auto with = [](const std::function<void(ReportConfig&)>& change) {
    ReportConfig c;
    change(c);
    Findings found;
    check_limits(c, found);
    return warnings(found);
  };
  CHECK(with([](ReportConfig& c) { c.energy_warning = 0.01; }).empty());
  CHECK(with([](ReportConfig&) {}).empty());
  CHECK_THAT(with([](ReportConfig& c) { c.energy_warning = 0.5; }),
             Contains("energy_warning: 0.5"));
  CHECK_THAT(with([](ReportConfig& c) { c.momentum_warning = 1.0; }), Contains("impulse"));
  CHECK_THAT(with([](ReportConfig& c) { c.mass_warning = 0.1; }), Contains("mass_warning: 0.1"));
}

TEST_CASE("Too few points, or more than help, are seen") {
  const auto with = [](int points, Seeding seeding, double cell) {
    MapConfig map;
    map.cell = cell;
    map.points_per_cell = points;
    map.seeding = seeding;
    Findings found;
    check_points(flow(cell), map, soil(), found);
    return found;
  };
  CHECK(warnings(with(2, Seeding::lattice, 1.25)).empty());
  CHECK(warnings(with(4, Seeding::lattice, 1.25)).empty());
  CHECK_THAT(warnings(with(1, Seeding::lattice, 1.25)), Contains("1 per cell"));
  CHECK_THAT(warnings(with(8, Seeding::lattice, 1.25)), Contains("16 times as long"));
  // Elements of 2 m with two points across.
  CHECK(warnings(with(2, Seeding::gauss, 2.0)).empty());
  CHECK_THAT(warnings(with(2, Seeding::gauss, 1.25)), Contains("1.2 per cell"));
  CHECK(errors(with(2, Seeding::gauss, 1.25)).empty());
  CHECK_THAT(errors(with(2, Seeding::gauss, 0.5)), Contains("0.5 points per cell"));
}

TEST_CASE("Linear functions, and cells too coarse for mls, are seen") {
  FlowConfig c = flow(1.0);
  const auto said = [&c](mpm::BasisKind basis,
                         void (*rule)(const FlowConfig&, const Soil&, Findings&)) {
    c.basis = basis;
    Findings found;
    rule(c, soil(), found);
    return warnings(found);
  };
  using mpm::BasisKind;
  CHECK(said(BasisKind::quadratic, check_scheme).empty());
  CHECK(said(BasisKind::mls, check_cells).empty());
  CHECK_THAT(said(BasisKind::linear, check_scheme), Contains("basis: linear"));
  c.cell = 4.0;
  CHECK_THAT(said(BasisKind::mls, check_cells), Contains("with basis mls by more"));
  CHECK_THAT(said(BasisKind::quadratic, check_cells), !Contains("mls"));
}

TEST_CASE("Water that is not handed over, and errors that an audit would pass, are seen") {
  const auto with = [](const std::function<void(MapConfig&)>& change) {
    MapConfig c;
    change(c);
    Findings found;
    check_transfer_rules(c, found);
    return warnings(found);
  };
  CHECK(with([](MapConfig&) {}).empty());
  CHECK(with([](MapConfig& c) { c.audit.stress = 1e-3; }).empty());
  CHECK_THAT(with([](MapConfig& c) { c.audit.stress = 1.0; }), Contains("audit.stress: 1 passes"));
  CHECK_THAT(with([](MapConfig& c) { c.friction_acts_on = FrictionStress::total; }),
             Contains("friction_acts_on: total"));
  CHECK(with([](MapConfig& c) { c.c_soft_ratio = 0.25; }).empty());
  CHECK_THAT(with([](MapConfig& c) { c.c_soft_ratio = 0.001; }),
             Contains("c_soft_ratio: 0.001 leaves liquefied soil with 0.1 % of"));
}

TEST_CASE("A Poisson's ratio that costs steps and gives nothing is seen") {
  const auto with = [](double poisson) {
    MapConfig map;
    map.cell = 1.25;
    map.materials = {{"dam", softening_soil()}};
    map.materials["dam"].law.of<MohrCoulomb>()->poisson_ratio = poisson;
    Findings found;
    check_map_materials(map, {{"dam", 1, 1900.0}}, soil(), found);
    return warnings(found);
  };
  CHECK(with(0.3).empty());
  CHECK(with(0.495).empty());
  CHECK(with(0.498).empty());
  CHECK_THAT(with(0.4995), Contains("dam.poisson_ratio: 0.4995 takes 3.1 times"));
}
