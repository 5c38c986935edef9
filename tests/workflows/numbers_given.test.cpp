#include "workflows/stages/numbers_given.hpp"

#include "report/facts.hpp"
#include "tests/support/paths.hpp"
#include "tests/support/scratch.hpp"

#include <algorithm>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

using namespace flowslide;

namespace {

/// Names of the numbers of a JSON object, with those of its groups; null is one that may be there.
void collect(const std::string& before, const nlohmann::json& object,
             std::vector<std::string>& names) {
  for (const auto& [key, value] : object.items()) {
    if (value.is_object())
      collect(before + key + ".", value, names);
    else if (value.is_number() || value.is_null())
      names.push_back(before + key);
  }
}

}  // namespace

TEST_CASE("The list of what a report gives has all its numbers") {
  std::vector<std::string> names;
  collect("", nlohmann::json::parse(to_json(ReportFacts{})), names);
  REQUIRE(names.size() > 40);
  const std::vector<std::string> given = numbers_given("report.runout", "");
  for (const std::string& name : names) {
    CAPTURE(name);
    CHECK(std::find(given.begin(), given.end(), name) != given.end());
  }
}

TEST_CASE("The lists have every number that the stages gave on small cases") {
  const auto cases = nlohmann::json::parse(read_text_file(test::fixture("results/facts.json")));
  std::vector<std::string> given, names;
  for (const auto& [kind, found] : cases.items()) {
    const std::string type = kind.substr(0, kind.find(','));
    const auto list = numbers_given(type, "windows.\"all\".from = 0 m\n");
    CHECK_FALSE(list.empty());
    given.insert(given.end(), list.begin(), list.end());
    // these hold their audit as well, which is a result of its own and no column
    if (!type.starts_with("transfer.map") && !type.starts_with("transfer.sordo"))
      collect("", found["facts"], names);
  }
  REQUIRE(names.size() > 90);
  for (const std::string& name : names) {
    CAPTURE(name);
    CHECK(std::find(given.begin(), given.end(), name) != given.end());
  }
}

TEST_CASE(
    "Windows and regions are among what stages give, and other types give what is not known") {
  const auto has = [](const std::vector<std::string>& all, const char* name) {
    return std::find(all.begin(), all.end(), name) != all.end();
  };
  const auto zone = numbers_given("transfer.zone", "windows.\"pond\".from = -70 m\n");
  CHECK(has(zone, "liquefaction_depth_pond_m"));
  CHECK_FALSE(has(zone, "liquefaction_depth_crest_m"));
  CHECK(has(numbers_given("report.runout", "regions.\"lower dam\".outline = []\n"),
            "regions.lower dam.failed_share"));
  CHECK(numbers_given("sample.number", "").empty());
}
