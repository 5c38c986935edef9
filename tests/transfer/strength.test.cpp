#include "transfer/zone/strength.hpp"

#include "core/check.hpp"

#include <catch2/catch.hpp>

using namespace flowslide;

namespace {
StrengthConfig paper_table() {
  return {.table = {{25e3, 3.0e3},
                    {50e3, 4.3e3},
                    {75e3, 5.6e3},
                    {100e3, 6.5e3},
                    {125e3, 7.4e3},
                    {175e3, 9.1e3},
                    {225e3, 10.6e3},
                    {250e3, 11.1e3},
                    {275e3, 11.5e3},
                    {325e3, 12e3}}};
}
}  // namespace

TEST_CASE("binned strength is the curve at the middle of half-open bins", "[transfer]") {
  StrengthConfig c = paper_table();
  c.rule = StrengthRule::binned;
  check(c);
  const auto at = [&c](double kpa) { return strength_at(c, kpa * 1e3); };
  CHECK((at(0.0).layer == 0 && at(0.0).strength == Approx(3.0e3)));
  CHECK((at(49.999).layer == 0 && at(49.999).strength == Approx(3.0e3)));
  CHECK((at(50.0).layer == 1 && at(50.0).strength == Approx(5.6e3)));
  CHECK((at(100.0).layer == 2 && at(100.0).strength == Approx(7.4e3)));
  CHECK((at(299.999).layer == 5 && at(299.999).strength == Approx(11.5e3)));
  CHECK((at(300.0).layer == 6 && at(300.0).strength == Approx(12e3)));
  CHECK((at(5000.0).layer == 6 && at(5000.0).strength == Approx(12e3)));
  CHECK_FALSE(at(300.0).clamped);
  CHECK((at(-3.0).layer == 0 && at(-3.0).strength == Approx(3.0e3) && at(-3.0).clamped));
}

TEST_CASE("interpolated strength follows the table and stays inside it", "[transfer]") {
  const StrengthConfig c = paper_table();
  CHECK(strength_at(c, 50e3).strength == Approx(4.3e3));
  CHECK(strength_at(c, 60e3).strength == Approx(4.82e3));
  CHECK(strength_at(c, 25e3).strength == Approx(3e3));
  CHECK_FALSE(strength_at(c, 25e3).clamped);
  CHECK((strength_at(c, 24e3).strength == 3e3 && strength_at(c, 24e3).clamped));
  CHECK_FALSE(strength_at(c, 325e3).clamped);
  CHECK((strength_at(c, 400e3).strength == 12e3 && strength_at(c, 400e3).clamped));
  CHECK(strength_at(c, 160e3).layer == 3);
}

TEST_CASE("a table of one row is a constant", "[transfer]") {
  const StrengthConfig c{.table = {{100e3, 7e3}}};
  check(c);
  for (const double sigma : {0.0, 100e3, 1e6}) CHECK(strength_at(c, sigma).strength == 7e3);
}

TEST_CASE("bad strength tables are refused", "[transfer]") {
  CHECK_THROWS_WITH(check(StrengthConfig{}), Catch::Contains("strength.table is empty"));
  CHECK_THROWS_WITH(check(StrengthConfig{.table = {{50e3, 4e3}, {50e3, 5e3}}}),
                    Catch::Contains("row 2") && Catch::Contains("sort the rows"));
  CHECK_THROWS_WITH(check(StrengthConfig{.table = {{50e3, kUnset}}}),
                    Catch::Contains("S_r is nan"));
  CHECK_THROWS_WITH(check(StrengthConfig{.table = {{50e3}}}), Catch::Contains("1 numbers"));
  CHECK_THROWS_AS(check(StrengthConfig{.table = {{-1.0, 4e3}}}), InputError);
  CHECK_THROWS_WITH(check(StrengthConfig{.table = {{50e3, 4e3}}, .last_bin = 310e3}),
                    Catch::Contains("not a multiple"));
}
