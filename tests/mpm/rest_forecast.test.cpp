#include "mpm/run/rest_forecast.hpp"

#include <catch2/catch.hpp>

namespace flowslide {

TEST_CASE("the time of rest is known from a braking block", "[mpm]") {
  // Speed grows to 10 m/s in 10 s and falls at 0.25 m/s2, to a tenth of it at 46 s.
  RestForecast forecast;
  const auto speed = [](double t) { return t < 10.0 ? t : 10.0 - 0.25 * (t - 10.0); };
  for (double t = 0.0; t <= 10.0; t += 0.5) forecast.look(t, speed(t) * speed(t));
  CHECK_FALSE(forecast.rest(100.0, 0.01));
  for (double t = 10.5; t <= 20.0; t += 0.5) forecast.look(t, speed(t) * speed(t));
  REQUIRE(forecast.rest(100.0, 0.01));
  CHECK(*forecast.rest(100.0, 0.01) == Approx(46.0));
  for (double t = 20.5; t <= 46.0; t += 0.5) forecast.look(t, speed(t) * speed(t));
  CHECK(*forecast.rest(100.0, 0.01) == Approx(46.0));
  // What speeds up again has no time of rest.
  for (double t = 46.5; t <= 60.0; t += 0.5) forecast.look(t, (t - 40.0) * (t - 40.0));
  CHECK_FALSE(forecast.rest(100.0, 0.01));
}

}  // namespace flowslide
