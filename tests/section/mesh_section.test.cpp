#include "section/mesh_section.hpp"

#include "core/check.hpp"
#include "section/quality.hpp"
#include "tests/section/section.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include <catch2/catch.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

using namespace flowslide;
using Catch::Matchers::Contains;

namespace {

constexpr const char* kTwoBlocks = R"(
size: 1 m
materials: {sand: {tag: 1}, clay: {tag: 2}}
blocks:
  below: {outline: [[0 m, 0 m], [6 m, 0 m], [6 m, 2 m], [0 m, 2 m]], material: clay}
  above: {outline: [[2 m, 2 m], [4 m, 2 m], [4 m, 5 m], [2 m, 5 m]], material: sand}
)";

std::string with(std::string text, const std::string& old, const std::string& replacement) {
  const auto at = text.find(old);
  REQUIRE(at != std::string::npos);
  return text.replace(at, old.size(), replacement);
}

double total_area(const QuadMesh& mesh) {
  double sum = 0.0;
  for (std::size_t e = 0; e < mesh.num_elements(); ++e) sum += area(corners(mesh, mesh.nodes, e));
  return sum;
}

/// Elements on each inner edge: 2 everywhere in a mesh whose edges match.
int largest_share(const QuadMesh& mesh) {
  std::map<std::pair<int, int>, int> count;
  int most = 0;
  for (const auto& n : mesh.elements)
    for (std::size_t k = 0; k < 4; ++k)
      most = std::max(most, ++count[std::minmax(n[k], n[(k + 1) % 4])]);
  return most;
}

double length_of(const SectionMesh& s, const std::string& name) {
  double sum = 0.0;
  for (const auto& [a, b] : find_set(s, name).edges)
    sum += std::hypot(s.mesh.nodes[b][0] - s.mesh.nodes[a][0],
                      s.mesh.nodes[b][1] - s.mesh.nodes[a][1]);
  return sum;
}

}  // namespace

TEST_CASE("blocks that share part of a side get one mesh") {
  const SectionMesh s = mesh_section(section_of(kTwoBlocks));
  CHECK(s.mesh.num_elements() == 6 * 2 + 2 * 3);
  CHECK(s.mesh.num_nodes() == 7 * 3 + 3 * 3);
  CHECK(total_area(s.mesh) == Approx(18.0));
  CHECK(std::count(s.mesh.element_material.begin(), s.mesh.element_material.end(), 1) == 6);
  CHECK(length_of(s, "base") == Approx(6.0));
  CHECK(length_of(s, "left") == Approx(2.0));
  CHECK(length_of(s, "right") == Approx(2.0));
  CHECK(length_of(s, "surface") == Approx(2.0 + 3.0 + 2.0 + 3.0 + 2.0));
  const MeshQuality q = measure_quality(s.mesh);
  CHECK(q.jacobian_ratio.value == Approx(1.0));
  CHECK(q.angle.value == Approx(0.0).margin(1e-9));
  CHECK(s.notes.empty());
}

TEST_CASE("the section of the Mochikoshi dam is meshed with usable elements") {
  const SectionConfig config = mochikoshi();
  const SectionMesh s = mesh_section(config);
  // The shoelace formula over the tailings, by hand: (-340,0) (0,0) (20,12.5) (17.42,12.5)
  // (-38,30).
  const double tailings =
      0.5 * (0.0 * 12.5 - 20.0 * 0.0 + 20.0 * 12.5 - 17.42 * 12.5 + 17.42 * 30.0 + 38.0 * 12.5 +
             -38.0 * 30.0 + 340.0 * 30.0 + -340.0 * 0.0 + 340.0 * 30.0);
  const double dams = 0.5 * (75.0 + 15.42) * 12.5 + 18.0 * 17.5;
  CHECK(total_area(s.mesh) == Approx(5.0 * 427.5 + dams + tailings).epsilon(1e-9));
  CHECK(largest_share(s.mesh) == 2);
  CHECK(length_of(s, "base") == Approx(427.5));
  CHECK(length_of(s, "left") == Approx(35.0));
  CHECK(length_of(s, "right") == Approx(5.0));
  CHECK(length_of(s, "pond") == Approx(302.0));
  CHECK(length_of(s, "toe_drain") == Approx(14.2));
  const MeshQuality q = measure_quality(s.mesh);
  CHECK(q.jacobian_ratio.value > 0.5);
  // The faces of the dam fall at 17.5 degrees; no element can have a blunter corner there.
  CHECK(q.angle.value < 90.0 - 17.0);
  CHECK(q.aspect.value < 10.0);
}

TEST_CASE("sizes follow x, and sides take over the spacing of what lies opposite") {
  const SectionMesh s = mesh_section(section_of(R"(
size: 1 m
size_along_x: [[0 m, 4 m], [40 m, 1 m]]
materials: {sand: {tag: 1}}
blocks:
  all: {outline: [[0 m, 0 m], [40 m, 0 m], [40 m, 4 m], [0 m, 4 m]], material: sand}
)"));
  // The integral of dx / h with h from 4 to 1 over 40 m: 40/3 ln 4 = 18.5.
  CHECK(find_set(s, "base").edges.size() >= 18);
  CHECK(find_set(s, "base").edges.size() <= 19);
  double longest = 0.0;
  for (const auto& [a, b] : find_set(s, "base").edges)
    longest = std::max(longest, std::abs(s.mesh.nodes[b][0] - s.mesh.nodes[a][0]));
  CHECK(longest == Approx(4.0).epsilon(0.12));
}

TEST_CASE("settings that have no part in the mesh are told") {
  const auto notes_with = [](const std::string& sizes, const std::string& materials) {
    const SectionMesh s = mesh_section(
        section_of("size: 2 m\nsize_along_x: " + sizes + "\nmaterials: " + materials + R"(
blocks:
  all: {outline: [[0 m, 0 m], [40 m, 0 m], [40 m, 4 m], [0 m, 4 m]], material: sand}
)"));
    return s.notes;
  };
  CHECK(notes_with("[[0 m, 4 m], [40 m, 1 m]]", "{sand: {tag: 1}}").empty());
  const auto beyond = notes_with("[[400 m, 4 m], [900 m, 1 m]]", "{sand: {tag: 1}}");
  REQUIRE(beyond.size() == 1);
  CHECK_THAT(beyond[0], Contains("x = 400 to 900 m") && Contains("from 0 to 40 m"));
  const auto finer = notes_with("[[0 m, 0.2 m], [40 m, 0.3 m]]", "{sand: {tag: 1}}");
  REQUIRE(finer.size() == 1);
  CHECK_THAT(finer[0], Contains("size: 2 m has no part in the mesh") && Contains("0.2 to 0.3 m"));
  const auto idle = notes_with("[[0 m, 2 m]]", "{sand: {tag: 1}, clay: {tag: 2}}");
  REQUIRE(!idle.empty());
  CHECK_THAT(idle.back(), Contains("'clay': no element"));
}

TEST_CASE("a crest that is narrow for its elements is told with its price") {
  const auto mesh_with = [](const std::string& size) {
    return mesh_section(section_of("size: " + size + R"(
materials: {sand: {tag: 1}}
blocks:
  ground: {outline: [[-60 m, -10 m], [97 m, -10 m], [97 m, 0 m], [-60 m, 0 m]], material: sand}
  dam: {outline: [[0 m, 0 m], [37 m, 0 m], [20 m, 12 m], [15 m, 12 m]], material: sand}
)"));
  };
  // 18 elements of 2 m cross the base, and as many the 5 m of the crest.
  const SectionMesh s = mesh_with("2 m");
  REQUIRE(s.notes.size() == 1);
  CHECK_THAT(s.notes[0], Contains("m thin") && Contains("times more steps") && Contains(", 11."));
  const MeshQuality q = measure_quality(s.mesh);
  CHECK(q.median_thickness / q.thickness.value > 4.0);
  // The control: blocks that end where the section narrows.
  const SectionMesh stepped = mesh_section(section_of(R"(
size: 2 m
materials: {sand: {tag: 1}}
blocks:
  ground: {outline: [[-60 m, -10 m], [97 m, -10 m], [97 m, 0 m], [-60 m, 0 m]], material: sand}
  low: {outline: [[0 m, 0 m], [37 m, 0 m], [25 m, 8.5 m], [11 m, 8.5 m]], material: sand}
  high: {outline: [[14 m, 8.5 m], [22 m, 8.5 m], [20 m, 12 m], [15 m, 12 m]], material: sand}
)"));
  CHECK(measure_quality(stepped.mesh).thickness.value > 1.5 * q.thickness.value);
}

TEST_CASE("a block of three corners becomes three grids") {
  const SectionMesh s = mesh_section(section_of(R"(
size: 1 m
materials: {sand: {tag: 1}}
blocks:
  all: {outline: [[0 m, 0 m], [8 m, 0 m], [4 m, 7 m]], material: sand}
)"));
  CHECK(total_area(s.mesh) == Approx(28.0));
  CHECK(largest_share(s.mesh) == 2);
  CHECK(measure_quality(s.mesh).jacobian_ratio.value > 0.5);
  CHECK(s.sets.empty());
  REQUIRE(s.notes.size() == 1);
  CHECK_THAT(s.notes[0], Contains("no vertical ends"));
}

TEST_CASE("numbers of elements can be given, and contradictions are named") {
  const std::string text =
      with(kTwoBlocks, "material: clay}", "material: clay, divisions: [9, 0]}");
  CHECK(find_set(mesh_section(section_of(text)), "base").edges.size() == 9);
  const std::string both = with(text, "material: sand}", "material: sand, divisions: [9, 3]}");
  CHECK_THROWS_WITH(mesh_section(section_of(both)), Contains("block '") && Contains("divisions"));
}

TEST_CASE("zones change the material of the elements inside") {
  const SectionMesh s = mesh_section(section_of(std::string(kTwoBlocks) + R"(
zones:
  lens: {outline: [[0 m, 0 m], [3 m, 0 m], [3 m, 1 m], [0 m, 1 m]], material: sand}
)"));
  CHECK(std::count(s.mesh.element_material.begin(), s.mesh.element_material.end(), 1) == 6 + 3);
}

TEST_CASE("bad sections are explained") {
  const auto error = [](const std::string& old, const std::string& replacement) {
    try {
      mesh_section(section_of(with(kTwoBlocks, old, replacement)));
    } catch (const InputError& e) {
      return std::string(e.what());
    }
    return std::string("no error");
  };
  const std::string above = "[[2 m, 2 m], [4 m, 2 m], [4 m, 5 m], [2 m, 5 m]]";
  CHECK_THAT(error(above, "[[2 m, 1.99 m], [4 m, 2 m], [4 m, 5 m], [2 m, 5 m]]"),
             Contains("block 'above'") && Contains("0.01 m"));
  CHECK_THAT(error(above, "[[2 m, 1 m], [4 m, 1 m], [4 m, 5 m], [2 m, 5 m]]"),
             Contains("'above' and 'below' overlap") && Contains("cross at"));
  CHECK_THAT(error(above, "[[2 m, 0.5 m], [4 m, 0.5 m], [4 m, 1 m], [2 m, 1 m]]"),
             Contains("overlap: the point"));
  CHECK_THAT(error(above, "[[2 m, 3 m], [4 m, 3 m], [4 m, 5 m], [2 m, 5 m]]"),
             Contains("falls into 2 parts") && Contains("'above'"));
  CHECK_THAT(error(above, "[[6 m, 2 m], [8 m, 2 m], [8 m, 5 m], [6 m, 5 m]]"),
             Contains("at the point (6, 2) only"));
  CHECK_THAT(error(above, "[[2 m, 2 m], [2 m, 5 m], [4 m, 5 m], [4 m, 2 m]]"),
             Contains("block 'above'") && Contains("clockwise"));
  CHECK_THAT(error(above, "[[2 m, 2 m], [4 m, 5 m], [4 m, 2 m], [2 m, 5 m]]"),
             Contains("crosses itself at (3, 3.5)"));
  CHECK_THAT(error(above, "[[2 m, 2 m], [4 m, 2 m], [4 m, 5 m], [3 m, 5 m], [2 m, 5 m]]"),
             Contains("5 points") && Contains("corners: [1, 2, 3, 5]"));
  CHECK_THAT(error("material: sand}", "material: sands}"), Contains("no material 'sands'"));
  CHECK_THAT(error("size: 1 m", "size: 1 mm"), Contains("elements") && Contains("units"));
  CHECK_THAT(error("{tag: 2}", "{tag: 1}"), Contains("tag 1 is that of another"));
  CHECK_THAT(error("{tag: 2}", "{}"), Contains("'tag' is missing"));
  const std::string set = "material: sand}\nsets: {pond: {line: [[0 m, 2 m], [2 m, 2.5 m]]}}";
  CHECK_THAT(error("material: sand}", set), Contains("set 'pond'") && Contains("0 m of"));
  // The inner corner of an L is no place for a side of one grid.
  CHECK_THAT(error(above + ", material",
                   "[[2 m, 2 m], [4 m, 2 m], [4 m, 2.6 m], [2.6 m, 2.6 m], [2.6 m, 9 m], "
                   "[2 m, 9 m]], corners: [1, 2, 5, 6], material"),
             Contains("block 'above'") && Contains("folds over"));
}

TEST_CASE("a wedge left open between blocks is told with its place and width") {
  const auto notes = [](const std::string& bottom) {
    const SectionMesh s = mesh_section(section_of(R"(
size: 0.5 m
materials: {sand: {tag: 1}}
blocks:
  below: {outline: [[0 m, 0 m], [6 m, 0 m], [6 m, 2 m], [0 m, 2 m]], material: sand}
  above: {outline: [[2 m, 2 m], [3 m, 2 m], )" + bottom +
                                                  R"(, [4 m, 5 m], [2 m, 5 m]],
          corners: [1, 3, 4, 5], material: sand}
)"));
    return fmt::format("{}", fmt::join(s.notes, "\n"));
  };
  // 2 sin(11.31/2 deg) times the shorter side, 1.02 m
  CHECK_THAT(notes("[4 m, 2.2 m]"), Contains("wedge is left open at (3, 2)") &&
                                        Contains("'above', 'below'") &&
                                        Contains("0.201 m wide 1.02 m away"));
  CHECK_THAT(notes("[4 m, 2 m]"), !Contains("wedge"));    // control: closed
  CHECK_THAT(notes("[4 m, 2.6 m]"), !Contains("wedge"));  // 31 degrees
}

TEST_CASE("holes between blocks are found") {
  CHECK_THROWS_WITH(mesh_section(section_of(R"(
size: 1 m
materials: {sand: {tag: 1}}
blocks:
  south: {outline: [[0 m, 0 m], [6 m, 0 m], [6 m, 2 m], [0 m, 2 m]], material: sand}
  north: {outline: [[0 m, 4 m], [6 m, 4 m], [6 m, 6 m], [0 m, 6 m]], material: sand}
  west: {outline: [[0 m, 2 m], [2 m, 2 m], [2 m, 4 m], [0 m, 4 m]], material: sand}
  east: {outline: [[4 m, 2 m], [6 m, 2 m], [6 m, 4 m], [4 m, 4 m]], material: sand}
)")),
                    Contains("hole of 4 m2") && Contains("'north', 'south'"));
}
