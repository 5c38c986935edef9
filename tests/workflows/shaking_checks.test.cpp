#include "core/check.hpp"
#include "workflows/stages/cross_checks.hpp"

#include <functional>

#include <catch2/catch.hpp>
#include <fmt/format.h>

/// Ends of a shaken section, what is recorded of it, and what an import says of its soil.
using namespace flowslide;
using Catch::Contains;

namespace {

std::string warnings(const Findings& f) { return fmt::format("{}", fmt::join(f.warnings, "\n")); }

/// 120 m long, 30 m high on the left and `right` on the right.
QuadMesh section(double right, int columns = 12) {
  QuadMesh m;
  for (int i = 0; i <= columns; ++i) {
    const double x = 120.0 * i / columns, share = x / 120.0;
    m.nodes.push_back({x, 0.0});
    m.nodes.push_back({x, 30.0 + share * (right - 30.0)});
  }
  for (std::int32_t i = 0; i < columns; ++i)
    m.elements.push_back({2 * i, 2 * i + 2, 2 * i + 3, 2 * i + 1});
  return m;
}

}  // namespace

TEST_CASE("Ends of a section that do not let it shake as the ground does are seen") {
  const auto held = [](double right, const std::function<void(FemSideConfig&)>& change) {
    FemConfig c;
    change(c.sides);
    Findings found;
    check_sides(c, section(right), found);
    return warnings(found);
  };
  const auto kind = [](SideKind k) { return [k](FemSideConfig& s) { s.kind = k; }; };
  CHECK(held(5.0, kind(SideKind::free_field)).empty());
  CHECK(held(30.0, kind(SideKind::tied)).empty());
  CHECK_THAT(held(5.0, kind(SideKind::tied)), Contains("30 m high and the other 5 m"));
  CHECK_THAT(held(30.0, kind(SideKind::fixed)), Contains("sides.kind: fixed"));
  CHECK_THAT(held(30.0, [](FemSideConfig& s) { s.thickness = 1.0; }),
             Contains("sides.thickness: columns of 1 m"));
}

TEST_CASE("A shaking that is hardly recorded, or more than a disk holds, is seen") {
  const auto every = [](double interval, int columns, std::optional<double> end,
                        std::optional<double> period = {}) {
    FemConfig c;
    c.output_interval = interval;
    Findings found;
    check_recording(c, section(5.0, columns), end, period, found);
    return warnings(found);
  };
  CHECK(every(0.25, 12, 48.0).empty());
  CHECK(every(0.25, 12, std::nullopt).empty());
  CHECK_THAT(every(100.0, 12, std::nullopt), Contains("output_interval: 100 s"));
  CHECK(every(0.1, 12, 48.0, 0.4).empty());
  CHECK(every(0.2, 12, 48.0, 0.4).empty());
  CHECK_THAT(every(0.25, 12, 48.0, 0.4),
             Contains("1.6 states in a mean period") && Contains("Take 0.1 s"));
  CHECK(every(1e-3, 100, 48.0).empty());
  CHECK_THAT(every(1e-3, 10000, 48.0), Contains("4.8e+04 states") && Contains("GB"));
}

TEST_CASE("A void ratio in place of a porosity is seen by its grains") {
  const auto of = [](double density, double porosity) {
    Findings found;
    check_densities({{"sand", 1, density, porosity}}, found);
    return fmt::format("{}{}", fmt::join(found.errors, "\n"), warnings(found));
  };
  CHECK(of(1870.0, 0.5).empty());
  CHECK(of(1600.0, 0.4).empty());  // dry
  CHECK(of(1870.0, kUnset).empty());
  CHECK_THAT(of(1870.0, 0.99), Contains("porosity is no void ratio"));
}

TEST_CASE("An earth pressure at rest that no soil has is seen") {
  const auto of = [](double k0) {
    Findings found;
    check_k0(k0, found);
    return warnings(found);
  };
  CHECK(of(0.5).empty());
  CHECK_THAT(of(50.0), Contains("sigma_zz.k0: 50"));
  CHECK_THAT(of(0.005), Contains("0.2 to 3"));
}
