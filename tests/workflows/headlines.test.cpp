#include "workflows/engine/headlines.hpp"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

using namespace flowslide;

TEST_CASE("a run prints what its last stage says first, then what others add", "[workflows]") {
  const std::string zone =
      add_headlines(R"({"depth": 3})", {{"depth", "depth", "m"}, {"at", "at"}});
  const std::string report = add_headlines(
      R"({"runout_m": 0})", {{"runout_m", "runout", "m", "short of it"}, {"at", "moment"}});
  CHECK(nlohmann::json::parse(zone)["depth"] == 3);
  const std::vector<Headline> all = merged_headlines({zone, R"({"mass": 1})", report});
  REQUIRE(all.size() == 3);
  CHECK(all[0].fact == "runout_m");
  CHECK(all[0].note == "short of it");
  CHECK(all[1].text == "moment");
  CHECK(all[2].fact == "depth");
  CHECK(all[2].unit == "m");
  CHECK(merged_headlines({R"({"mass": 1})"}).empty());
  CHECK(headlines_of("no JSON").empty());
  CHECK(headlines_of(R"({"headlines": [1, {"fact": 2}]})").size() == 1);
}
