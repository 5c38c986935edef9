#include "study/page/stories.hpp"

#include "report/page.hpp"
#include "report/page_arrays.hpp"
#include "study/page/curves.hpp"
#include "study/page/soil_rings.hpp"
#include "tests/support/scratch.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

using namespace flowslide;
using namespace flowslide::study;

namespace {

/// Squares of 1 m, six in a row and three rows of them, of soil 7; what `soft` takes is of soil 8.
struct Squares {
  std::vector<double> x, y, corners, material;
  double right = 6.0;

  template <class Soft>
  explicit Squares(Soft soft, double width = 6.0) : right(width) {
    for (int j = 0; j <= 3; ++j)
      for (int i = 0; i <= 6; ++i) {
        x.push_back(i * right / 6.0);
        y.push_back(j);
      }
    for (int j = 0; j < 3; ++j)
      for (int i = 0; i < 6; ++i) material.push_back(soft(i, j) ? 8.0 : 7.0);
    for (int c = 0; c < 4; ++c)
      for (int j = 0; j < 3; ++j)
        for (int i = 0; i < 6; ++i) corners.push_back(7 * (j + (c > 1)) + i + (c == 1 || c == 2));
  }

  [[nodiscard]] PageRun run() const {
    PageRun run;
    run.soils = {{7, "fill"}};
    run.arrays = {
        {"mesh.x", x}, {"mesh.y", y}, {"mesh.corners", corners}, {"mesh.material", material}};
    return run;
  }

  [[nodiscard]] std::string page(double front) const {
    PageArrays arrays;
    arrays.add("mesh.x", x);
    arrays.add("mesh.y", y);
    arrays.add("mesh.corners", corners, 4, Bits::sixteen, 1.0);
    arrays.add("mesh.material", material, 1, Bits::sixteen, 1.0);
    const nlohmann::json json{{"toe_m", 5.0},
                              {"front_m", front},
                              {"soils", {{{"tag", 7}, {"name", "fill"}}}},
                              {"ground", {{0.0, 0.0}, {6.0, 0.0}}},
                              {"water", {{0.0, 3.0, 2.0}, {1.0, 3.0, 2.0}, {2.0, 3.0, 2.0}}},
                              {"arrays", nlohmann::json::parse(arrays.index())}};
    return std::string(kPageRun) + json.dump() + "</script>" + std::string(kPageArrays) +
           arrays.text() + "</script>";
  }
};

/// Twice the area within a ring, by Gauss.
double twice_area(const Ring& ring) {
  double sum = 0.0;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const auto &a = ring[i], &b = ring[(i + 1) % ring.size()];
    sum += a[0] * b[1] - a[1] * b[0];
  }
  return std::abs(sum);
}

Table table_of(std::size_t rows) {
  Table t;
  t.rows = rows;
  return t;
}

}  // namespace

TEST_CASE("Soils are outlined by their corners, and one inside another is a hole", "[study]") {
  const auto areas = soil_areas(Squares([](int i, int j) { return i == 2 && j == 1; }).run());
  REQUIRE(areas.size() == 2);
  CHECK(areas[0].name == "fill");
  CHECK(areas[1].name == "soil 8");
  REQUIRE(areas[0].rings.size() == 2);
  std::vector<double> twice{twice_area(areas[0].rings[0]), twice_area(areas[0].rings[1])};
  std::sort(twice.begin(), twice.end());
  CHECK(twice == std::vector{2.0, 36.0});
  for (const Ring& ring : areas[0].rings) CHECK(ring.size() == 4);
  REQUIRE(areas[1].rings.size() == 1);
  CHECK(twice_area(areas[1].rings[0]) == 2.0);
}

TEST_CASE("Squares that touch at a corner alone keep their area", "[study]") {
  const auto areas =
      soil_areas(Squares([](int i, int j) { return j < 2 && i < 2 && i == j; }).run());
  double twice = 0.0;
  for (const Ring& ring : areas[1].rings) twice += twice_area(ring);
  CHECK(twice == 4.0);
}

TEST_CASE("Elements without nodes are refused", "[study]") {
  Squares s([](int, int) { return false; });
  CHECK(soil_areas(s.run()).size() == 1);
  const double node = s.corners[3];
  // 27.6 would be the node after the last
  for (const double wrong : {99.0, 27.6, -0.6, kUnset}) {
    s.corners[3] = wrong;
    CHECK_THROWS_AS(soil_areas(s.run()), InputError);
  }
  s.corners[3] = node;
  s.material[0] = kUnset;
  CHECK_THROWS_AS(soil_areas(s.run()), InputError);
  s.material[0] = 7.0;
  CHECK(soil_areas(s.run()).size() == 1);
  s.corners.pop_back();
  CHECK_THROWS_AS(soil_areas(s.run()), InputError);
  s.material.clear();
  CHECK(soil_areas(s.run()).empty());
}

TEST_CASE("A history is read at even places between its rows", "[study]") {
  CHECK(resampled({0, 1, 4}, {0, 10, 40}, 5) == std::vector<double>{0, 10, 20, 30, 40});
  CHECK(resampled({2, 2, 4}, {0, 8, 6}, 3) == std::vector<double>{8, 7, 6});
  CHECK(resampled({1}, {1}, 5).empty());
  CHECK(resampled({1, 1}, {1, 2}, 5).empty());
  CHECK(resampled({1, 2}, {1}, 5).empty());
}

TEST_CASE("Rows that share a shaking share its curves", "[study]") {
  Curves curves(4);
  CHECK_FALSE(curves.any());
  PageRun run;
  run.toe = 3.0;
  run.windows = {"pond"};
  run.arrays = {
      {"flow.t", {0, 1}},       {"flow.runout", {0, 5}},       {"zone.t", {0, 2}},
      {"crest.t", {0, 2}},      {"zone.deepest0", {0, 4}},     {"crest.down", {0, 1}},
      {"crest.across", {0, 2}}, {"spectrum.logT", {-1, 0, 1}}, {"spectrum.psa", {1, 9.81, 2}}};
  for (const char* name : {"flow.t", "flow.runout", "zone.deepest0", "crest.down", "spectrum.psa"})
    CHECK(is_for_curves(name));
  CHECK_FALSE(is_for_curves("points.x"));
  curves.add(0, run);
  run.arrays["flow.runout"] = {0, 7};
  curves.add(2, run);
  PageRun still;  // a static row, and one of an earlier program
  curves.add(3, still);
  REQUIRE(curves.any());
  const auto json = nlohmann::json::parse(curves.json());
  std::map<std::string, nlohmann::json> charts;
  for (const auto& c : json["charts"]) charts[c["name"]] = c;
  CHECK(charts.size() == 5);
  CHECK(charts["runout"]["of"] == nlohmann::json{0, -1, 1, -1});
  CHECK(charts["depth pond"]["of"] == nlohmann::json{0, -1, 0, -1});
  CHECK(charts["spectrum"]["of"] == nlohmann::json{0, -1, 0, -1});
  CHECK(charts["spectrum"]["from"][0] == Approx(0.1));
  CHECK(charts["spectrum"]["to"][0] == Approx(10.0));
  for (const auto& a : json["arrays"])
    if (a["name"] == "runout") CHECK(a["rows"] == 2);
}

TEST_CASE("The section of a study is that of its first run, and fronts are of all", "[study]") {
  Scratch scratch;
  const Squares one([](int i, int) { return i < 2; });
  const Squares other([](int i, int) { return i < 2; }, 9.0);
  scratch.write("a.html", one.page(7.0));
  scratch.write("b.html", one.page(11.004));
  scratch.write("c.html", other.page(4.0));
  std::string cut = one.page(5.0);
  cut.replace(cut.rfind("</script>") - 8, 8, "");
  scratch.write("d.html", cut);
  scratch.write("e.html", "<p>of another program</p>");
  const std::vector<std::string> reports{"", "a.html", "b.html", "c.html", "d.html", "e.html"};
  const Stories stories = read_stories(scratch / "", table_of(6), reports);
  REQUIRE(stories.has_section);
  CHECK(stories.damaged == std::vector<std::size_t>{4});
  const auto json = nlohmann::json::parse(stories.json);
  CHECK(json["fronts"] == nlohmann::json{nullptr, 7.0, 11.0, 4.0, nullptr, nullptr});
  const auto& section = json["section"];
  CHECK(section["row"] == 1);
  CHECK(section["toe"] == 5.0);
  CHECK(section["other_rows"] == "4");
  CHECK(section["soils"].size() == 2);
  // of three points of water on a line the middle one says nothing
  CHECK(section["water"].size() == 2);
  CHECK_FALSE(read_stories(scratch / "", table_of(2), {"", "e.html"}).has_section);
  const std::atomic<bool> stop = true;
  CHECK_THROWS_AS(read_stories(scratch / "", table_of(2), {"a.html", ""}, &stop), Interrupted);
}
