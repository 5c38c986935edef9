#include "core/benchmark.hpp"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

using namespace flowslide;

namespace {

std::vector<Measurement> none() { return {}; }
const std::vector<BenchCase> kCases{
    {"mpm/2d", "", none}, {"mpm/3d", "", none}, {"mpm/large", "", none, true}};

std::vector<std::string> names(std::initializer_list<std::string> asked, bool large = false) {
  std::vector<std::string> r;
  const std::vector<std::string> list(asked);
  for (const auto& c : select(kCases, list, large)) r.push_back(c.name);
  return r;
}

}  // namespace

TEST_CASE("Benchmarks are chosen by the beginning of their names", "[core]") {
  CHECK(names({}).size() == 2);
  CHECK(names({"mpm"}).size() == 2);
  CHECK(names({"mpm/3d/quadratic"}) == std::vector<std::string>{"mpm/3d"});
  CHECK(names({"mpm/large"}) == std::vector<std::string>{"mpm/large"});
  CHECK(names({"mpm/large/2d"}) == std::vector<std::string>{"mpm/large"});
  CHECK(names({}, true).size() == 3);
  CHECK(names({"mpm"}, true).size() == 3);
  CHECK_THROWS_AS(names({"fem"}), InputError);
  CHECK_THROWS_AS(names({"mpm/2day"}), InputError);
}

TEST_CASE("Measurements are written as JSON with their further facts", "[core]") {
  const Measurement m{.name = "mpm/2d",
                      .value = 13.1,
                      .unit = "Mupdates/s/core",
                      .better = Better::higher,
                      .numbers = {{"points", 640000.0}},
                      .texts = {{"law", "mohr_coulomb"}}};
  const auto json = nlohmann::json::parse(measurements_json(std::span(&m, 1)));
  CHECK(json[0]["name"] == "mpm/2d");
  CHECK(json[0]["value"] == 13.1);
  CHECK(json[0]["unit"] == "Mupdates/s/core");
  CHECK(json[0]["better"] == "higher");
  CHECK(json[0]["points"] == 640000.0);
  CHECK(json[0]["law"] == "mohr_coulomb");
  CHECK(measurement_row(m).size() <= 79);
}
