#include "core/units.hpp"

#include "core/check.hpp"

#include <cmath>
#include <string>

#include <catch2/catch.hpp>

using namespace flowslide;

TEST_CASE("quantities are converted to SI", "[core]") {
  CHECK(parse_quantity("20 MPa", Dim::stress) == 20e6);
  CHECK(parse_quantity("20MPa", Dim::stress) == 20e6);
  CHECK(parse_quantity(" -3.5 cm ", Dim::length) == Approx(-0.035));
  CHECK(parse_quantity("180 deg", Dim::angle) == Approx(3.141592653589793));
  CHECK(parse_quantity("0.3 g", Dim::acceleration) == Approx(2.943));
  CHECK(parse_quantity("0.7", Dim::none) == 0.7);
  CHECK(parse_quantity("1 %", Dim::none) == 0.01);
}

TEST_CASE("a missing or wrong unit is refused with a suggestion", "[core]") {
  CHECK_THROWS_WITH(parse_quantity("35", Dim::angle),
                    "'35' has no unit (angle expected, e.g. '35 rad')");
  CHECK_THROWS_WITH(parse_quantity("35 m", Dim::angle),
                    Catch::Contains("'m' is a unit of length (angle expected)"));
  CHECK_THROWS_WITH(parse_quantity("35 dag", Dim::angle), Catch::Contains("unknown unit 'dag'"));
  CHECK_THROWS_WITH(parse_quantity("0.5 m", Dim::none), Catch::Contains("a plain number"));
  CHECK_THROWS_WITH(parse_quantity("35 deg", Dim::none), Catch::Contains("tangent of the angle"));
  CHECK_THROWS_WITH(parse_quantity("0,3 g", Dim::acceleration),
                    Catch::Contains("'0,3 g' has ',' in a number"));
  CHECK_THROWS_AS(parse_quantity("nan m", Dim::length), InputError);
  CHECK_THROWS_AS(parse_quantity("1e999 m", Dim::length), InputError);
  CHECK_THROWS_AS(parse_quantity("", Dim::none), InputError);
}

TEST_CASE("text of a quantity reads back to the same bits", "[core]") {
  for (const double x : {0.1, 1.0 / 3.0, 1e-300, 2e7}) {
    CHECK(parse_quantity(to_text(x, Dim::stress), Dim::stress) == x);
  }
}

TEST_CASE("numbers are read without a locale", "[core]") {
  double value = 0.0;
  std::size_t used = 0;
  CHECK((parse_number("+1.5", value, used) && value == 1.5 && used == 4));
  CHECK((parse_number(".5 x", value, used) && value == 0.5 && used == 2));
  CHECK((parse_number("1e-005", value, used) && value == 1e-5));
  CHECK((parse_number("4e-310", value, used) && value == 4e-310));
  CHECK((parse_number("1e-400", value, used) && value == 0.0));
  // What no double holds is zero or infinite by its size, not by its spelling.
  const std::string zeros(400, '0');
  for (const std::string& small : {"0." + zeros + "1", "-0." + zeros + "1", "1" + zeros + "e-900",
                                   "." + zeros + "1e9", std::string("9E-0400")})
    CHECK((parse_number(small, value, used) && value == 0.0 && used == small.size()));
  for (const std::string& large : {"1" + zeros, "1" + zeros + ".5", "1" + zeros + "e-5",
                                   "0.001e" + std::string("400"), "-1" + zeros + "E+1"})
    CHECK((parse_number(large, value, used) && std::isinf(value) && used == large.size()));
  CHECK((parse_number("1,5", value, used) && used == 1));
  CHECK_FALSE(parse_number("+-1", value, used));
  CHECK_FALSE(parse_number("****", value, used));
}
