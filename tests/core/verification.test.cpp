#include "core/verification.hpp"

#include <algorithm>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

using namespace flowslide;
using Catch::Contains;

namespace {

std::vector<Check> good(std::string_view name) {
  CheckList checks(name);
  checks.near("a", 1.05, 1.0, 0.1, "m");
  return checks.take();
}
std::vector<Check> broken(std::string_view) { throw NumericsError("it blew up"); }

const std::vector<VerificationCase> kCases{
    {"mpm/v1", "", true, good}, {"mpm/v10", "", false, good}, {"fem/f1", "", true, broken}};

std::vector<std::string> names(std::initializer_list<std::string> asked, bool quick = false) {
  std::vector<std::string> r;
  const std::vector<std::string> list(asked);
  for (const auto& c : select(kCases, list, quick)) r.push_back(c.name);
  return r;
}

}  // namespace

TEST_CASE("A check passes within its tolerance and never on NaN", "[core]") {
  CheckList list("c");
  list.near("in", 1.1, 1.0, 0.11);
  list.near("out", 1.1, 1.0, 0.09);
  list.near("nan", kUnset, 1.0, 10.0);
  list.at_least("order", 2.3, 1.9);
  list.at_least("order_low", 1.8, 1.9);
  list.at_least("order_nan", kUnset, 1.9);
  list.at_most("peak", 1.0, 1.0);
  list.at_most("peak_nan", kUnset, 1.0);
  list.holds("yes", true);
  list.holds("no", false);
  std::string passed;
  for (const Check& c : list.take()) passed += c.pass ? '1' : '0';
  CHECK(passed == "1001001010");
}

TEST_CASE("Processor time is counted from check to check", "[core]") {
  CheckList list("c");
  double x = 1.0;
  const double start = core_seconds();
  while (core_seconds() < start + 0.01) x = std::sqrt(x + 1.0);
  list.near("busy", x, x, 0.0);
  list.near("idle", 0.0, 0.0, 0.0);
  const auto checks = list.take();
  CHECK(checks[0].core_seconds >= 0.01);
  CHECK(checks[1].core_seconds < 0.5 * checks[0].core_seconds);
}

TEST_CASE("Cases are chosen by group, name or beginning", "[core]") {
  CHECK(names({}) == std::vector<std::string>{"mpm/v1", "mpm/v10", "fem/f1"});
  CHECK(names({"mpm"}) == std::vector<std::string>{"mpm/v1", "mpm/v10"});
  CHECK(names({"fem", "mpm/v10"}) == std::vector<std::string>{"mpm/v10", "fem/f1"});
  CHECK(names({"mpm"}, true) == std::vector<std::string>{"mpm/v1"});
  CHECK_THROWS_WITH(names({"mpm", "mqm"}), Contains("'mqm'"));
}

TEST_CASE("An error inside a case is a check that fails", "[core]") {
  std::string message;
  CHECK(run_case(kCases[0], message).front().pass);
  CHECK(message.empty());
  const auto checks = run_case(kCases[2], message);
  REQUIRE(checks.size() == 1);
  CHECK_FALSE(checks[0].pass);
  CHECK(checks[0].name == "fem/f1/finished");
  CHECK_THAT(message, Contains("fem/f1") && Contains("it blew up"));
}

TEST_CASE("Checks are written as JSON and as lines of at most 79 columns", "[core]") {
  CheckList list("mpm/a_case_with_a_rather_long_name");
  list.near("speed", -1.23456789e-5, -1.3e-5, 2e-6, "m/s");
  list.at_least("a_quantity_with_a_long_name", kUnset, 1.9);
  const auto checks = list.take();
  const auto json = nlohmann::json::parse(checks_json(checks));
  REQUIRE(json.size() == 2);
  CHECK(json[0]["name"] == "mpm/a_case_with_a_rather_long_name/speed");
  CHECK(json[0]["value"] == -1.23456789e-5);
  CHECK(json[0]["pass"] == true);
  CHECK(json[0].size() == 7);
  CHECK(json[1]["value"].is_null());
  CHECK(json[1]["pass"] == false);
  for (const Check& c : checks) {
    const std::string row = check_row(c);
    CHECK_THAT(row, Contains(c.pass ? "pass" : "FAIL"));
    for (std::size_t at = 0; at < row.size();) {
      const std::size_t end = std::min(row.find('\n', at), row.size());
      CHECK(end - at <= 79);
      at = end + 1;
    }
  }
}
