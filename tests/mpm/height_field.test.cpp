#include "mpm/walls/height_field.hpp"

#include "mpm/walls/is_height_field.hpp"
#include "tests/mpm/scene.hpp"
#include "tests/mpm/solid.hpp"
#include "tests/support/scratch.hpp"

#include <fstream>
#include <sys/stat.h>

#include <catch2/catch.hpp>

using namespace flowslide;
using namespace flowslide::mpm;
using Catch::Matchers::Contains;

namespace {

/// Heights of a function on a grid over [-reach, reach].
template <class Height>
HeightField sampled(double reach, double spacing, Height&& height) {
  HeightField f;
  f.corner = {-reach, -reach};
  f.spacing = spacing;
  f.columns = f.rows = static_cast<int>(std::lround(2.0 * reach / spacing)) + 1;
  for (int j = 0; j < f.rows; ++j)
    for (int i = 0; i < f.columns; ++i)
      f.height.push_back(height(-reach + i * spacing, -reach + j * spacing));
  return f;
}

constexpr const char* kGrid =
    "ncols 4\nnrows 3\nxllcorner 100\nyllcorner 50\ncellsize 10\nNODATA_value -9999\n"
    "1 2 3 4\n5 6 7 8\n9 10 11 -9999\n";

HeightField read_text(const std::string& text, const MapPlace& place = {}) {
  const Scratch folder;
  std::ofstream(folder / "valley.asc") << text;
  return read_height_field(folder / "valley.asc", place);
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const auto at = text.find(from);
  REQUIRE(at != std::string::npos);
  return text.replace(at, from.size(), to);
}

}  // namespace

TEST_CASE("An ESRI grid is read from the north-west and placed on the map", "[mpm]") {
  const HeightField f = read_text(kGrid);
  CHECK(f.at(105.0, 55.0) == 9.0);  // the middle of the lowest cell on the left
  CHECK(f.at(105.0, 75.0) == 1.0);
  CHECK(f.at(110.0, 70.0) == Approx(3.5));
  CHECK(f.at(-1e3, 1e4) == 1.0);  // level beyond the edges
  CHECK(std::isnan(f.at(130.0, 57.0)));
  CHECK_THAT(f.name_place(130.0, 57.0), Contains("valley.asc:9 (row 3, column 4)"));
  CHECK(!f.complete);
  const HeightField centre = read_text(replaced(replaced(kGrid, "xllcorner 100", "XLLCENTER 105"),
                                                "yllcorner 50", "yllcenter 55\r"));
  CHECK(centre.at(110.0, 70.0) == f.at(110.0, 70.0));
  // x of the scene points north, y west, and its z = 0 is 3 m up.
  const HeightField turned = read_text(kGrid, {{125.0, 55.0}, 0.5 * kPi, 3.0});
  CHECK(turned.at(20.0, 0.0) == Approx(f.at(125.0, 75.0) - 3.0));
  CHECK(turned.at(10.0, 15.0) == Approx(f.at(110.0, 65.0) - 3.0));
}

TEST_CASE("A bad grid is refused with its line", "[mpm]") {
  const auto error = [](const std::string& from, const std::string& to) {
    return input_error([&] { read_text(replaced(kGrid, from, to)); });
  };
  CHECK_THAT(error("5 6 7 8", "5 6 7"), Contains("valley.asc:8: 3 heights") && Contains("ncols 4"));
  CHECK_THAT(error("5 6 7 8\n", ""), Contains("ends after 2 rows"));
  CHECK_THAT(error("5 6 7 8", "5 6 7 8\n5 6 7 8"), Contains("valley.asc:10: more rows"));
  CHECK_THAT(error("7 8", "nan 8"), Contains("valley.asc:8: 'nan' is not a finite number"));
  CHECK_THAT(error("1 2 3", "nan 2 3"), Contains("valley.asc:7: 'nan' is not"));
  CHECK_THAT(error("6 7", "6 7,5"), Contains("valley.asc:8: '7,5' has a decimal comma"));
  CHECK_THAT(error("6 7", "6 1e999"), Contains("valley.asc:8"));
  CHECK_THAT(error("cellsize 10", "dx 10"), Contains("valley.asc:5: 'dx' is no line"));
  CHECK_THAT(error("cellsize 10\n", ""), Contains("no cellsize"));
  CHECK_THAT(error("cellsize 10", "cellsize 0"), Contains("cellsize is 0"));
  CHECK_THAT(error("nrows 3", "nrows 1"), Contains("nrows"));
  CHECK_THAT(error("ncols 4", "ncols 4.5"), Contains("ncols"));
  CHECK_THAT(error("nrows 3", "ncols 3"), Contains("valley.asc:2: ncols is given twice"));
  CHECK_THAT(input_error([] { read_text("ncols 4\n"); }), Contains("no nrows"));
  CHECK_THAT(input_error([] { read_text(""); }), Contains("no ncols"));
  CHECK_THROWS_AS(read_height_field("/no/such.asc", {}), FileError);
}

TEST_CASE("A header that contradicts itself or leads nowhere is refused", "[mpm]") {
  const auto error = [](const std::string& from, const std::string& to) {
    return input_error([&] { read_text(replaced(kGrid, from, to)); });
  };
  for (const char* size : {"-10", "1e-300", "1e-9", "1e300", "1e7"})
    CHECK_THAT(error("cellsize 10", std::string("cellsize ") + size), Contains("cellsize is"));
  for (const char* corner : {"1e300", "-1e300", "1e16"})
    CHECK_THAT(error("xllcorner 100", std::string("xllcorner ") + corner),
               Contains("is lost in rounding"));
  CHECK_THAT(error("yllcorner 50", "xllcenter 105\nyllcorner 50"),
             Contains("xllcorner and xllcenter are both given"));
  CHECK_THAT(error("cellsize 10", "cellsize ten"),
             Contains("valley.asc:5: 'ten'") && Contains("it is the cellsize of the grid"));
  CHECK_THAT(error("NODATA_value -9999", "nodata_value nan"), Contains("such as -9999"));
  std::string old = kGrid;
  std::replace(old.begin(), old.end(), '\n', '\r');
  CHECK_THAT(input_error([&] { read_text(old); }), Contains("carriage return without a line feed"));
  CHECK_THAT(input_error([] {
               read_text(
                   "ncols 2\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 1\n-9999 -9999\n"
                   "-9999 -9999\n");
             }),
             Contains("every height is -9999"));
}

TEST_CASE("A grid is known by the first word of its header", "[mpm]") {
  CHECK(is_height_field(kGrid));
  CHECK(is_height_field("\xEF\xBB\xBFNROWS 3\n"));
  CHECK(is_height_field("\n  xllcorner 3\n"));
  CHECK(is_height_field("ncols=3"));
  for (const char* other : {"", "  ", "1 2 3", "# ncols", "ncolsx 3", "column 3"})
    CHECK_FALSE(is_height_field(other));
}

TEST_CASE("A place that is no number has a height that is none", "[mpm]") {
  const HeightField f = read_text(kGrid);
  CHECK(f.at(kUnset, 55.0) == f.at(105.0, 55.0));  // no index of the table comes from it
  for (const double far : {1e300, -1e300}) CHECK(is_set(f.at(far, 75.0)));
}

TEST_CASE("Missing heights are missing whatever the header says of them", "[mpm]") {
  const HeightField undeclared = read_text(replaced(kGrid, "NODATA_value -9999\n", ""));
  CHECK(!undeclared.complete);  // the format's own mark
  CHECK(std::isnan(undeclared.at(130.0, 57.0)));
  const auto error = [](const std::string& from, const std::string& to) {
    return input_error([&] { read_text(replaced(kGrid, from, to)); });
  };
  CHECK_THAT(error("NODATA_value -9999", "NODATA_value 0"),
             Contains("valley.asc:9: column 4: a height of -9999 m"));
  for (const char* mark : {"-32768", "-3.4e38", "32767", "1e20"})
    CHECK_THAT(error("7 8", std::string(mark) + " 8"),
               Contains("valley.asc:8: column 3") && Contains("write 'nodata_value"));
  CHECK_NOTHROW(read_text(replaced(kGrid, "7 8", "-430 8850")));  // the Dead Sea and Everest
}

TEST_CASE("A grid is not larger than its file, and marks of editors are no heights", "[mpm]") {
  const auto error = [](const std::string& from, const std::string& to) {
    return input_error([&] { read_text(replaced(kGrid, from, to)); });
  };
  CHECK_THAT(error("ncols 4", "ncols 100000"),
             Contains("100000 x 3 heights (the file is too short"));
  CHECK_THAT(error("ncols 4", "ncols 1e9"), Contains("ncols"));
  CHECK(read_text(std::string("\xEF\xBB\xBF") + kGrid).columns == 4);
  CHECK_THAT(error("6 7",
                   "6\xC2\xA0"
                   "7"),
             Contains("non-breaking space"));
}

TEST_CASE("Soil must not stand or come where the terrain has no height", "[mpm]") {
  ParticleSet p;
  p.materials = {elastic(1e6, 0.0)};
  add_block(p, {{126.0, 56.0, 20.0}, {129.0, 58.0, 22.0}}, 1.0, 1000.0);
  const Scratch folder;
  std::ofstream(folder / "valley.asc") << kGrid;
  FlowConfig config = free_space(2.0);
  config.ground.terrain.emplace();
  config.ground.terrain->file.path = folder / "valley.asc";
  CHECK_THAT(input_error([&] { make_simulation<3>(p, config); }),
             Contains("particle 1 ") && Contains("valley.asc:9 (row 3, column 4)"));
  config.ground.terrain->origin = {-20.0, 0.0};
  for (auto& v : p.velocity) v = {30.0, 0.0, 0.0};
  Run3 run(p, config);
  const auto go = [&] {
    while (run.s.time < 1.0) run.step();
  };
  REQUIRE_THROWS_WITH(go(), Contains("terrain has no height") && Contains("valley.asc:9"));
  CHECK(run.s.time > 0.3);

  ParticleSet flat;
  flat.materials = p.materials;
  add_lattice(flat, {0.0, 0.0, 1.0, 1.0}, 0.5, 1000.0);
  CHECK_THAT(input_error([&] { make_simulation<2>(flat, config); }), Contains("ground.terrain"));
}

namespace {

/// A block of stiff soil on a plane that rises along x and y, lattice and stress turned with it.
struct TiltedBlock {
  std::array<double, 2> slope;
  double friction;
  [[nodiscard]] double steepest() const { return std::hypot(slope[0], slope[1]); }
  [[nodiscard]] double angle() const { return std::atan(steepest()); }

  /// How far the middle goes down in `time`, and sideways.
  [[nodiscard]] std::array<double, 2> slid(double time) const {
    const double c = std::cos(angle()), s = std::sin(angle()), height = 1.0;
    const double ux = slope[0] / steepest(), uy = slope[1] / steepest();
    const std::array<std::array<double, 3>, 3> axis{
        {{c * ux, c * uy, s}, {-uy, ux, 0.0}, {-s * ux, -s * uy, c}}};
    ParticleSet p;
    p.materials = {elastic(20e6, 0.2)};
    add_block(p, {{0.0, 0.0, 0.0}, {2.0, 1.5, height}}, 0.125, 1800.0);
    for (std::size_t q = 0; q < p.size(); ++q) {
      const auto at = p.position[q];
      const double normal = -1800.0 * 9.81 * c * (height - at[2]);
      for (int d = 0; d < 3; ++d) {
        p.position[q][d] = 0.0;
        for (int k = 0; k < 3; ++k) p.position[q][d] += at[k] * axis[k][d];
      }
      const auto& n = axis[2];
      p.stress[q] = {normal * n[0] * n[0], normal * n[1] * n[1], normal * n[2] * n[2],
                     normal * n[0] * n[1], normal * n[1] * n[2], normal * n[2] * n[0]};
    }
    FlowConfig config = free_space(0.25);
    config.gravity = 9.81;
    Simulation<3> s3 = make_simulation<3>(p, config);
    s3.ground.friction = friction;
    s3.ground.field =
        sampled(20.0, 0.7, [&](double x, double y) { return slope[0] * x + slope[1] * y; });
    StepScratch<3> scratch(1);
    prepare(s3, scratch, true);
    const auto middle = [&](int k) {
      double sum = 0.0;
      for (std::size_t q = 0; q < s3.points.size(); ++q)
        for (int d = 0; d < 3; ++d) sum -= s3.points.x[d][q] * axis[k][d];
      return sum / double(s3.points.size());
    };
    const double down = middle(0), side = middle(1);
    while (s3.time < time) advance(s3, scratch);
    const double to_time = time * time / (s3.time * s3.time);
    return {(middle(0) - down) * to_time, (middle(1) - side) * to_time};
  }
};

}  // namespace

TEST_CASE("A block slides down a height field as Coulomb says, or sticks", "[mpm]") {
  const auto slope = GENERATE(std::array{0.5, 0.3}, std::array{-0.2, 0.4}, std::array{1.2, 0.4});
  const TiltedBlock smooth{slope, 0.0}, rough{slope, 0.15};
  CAPTURE(slope[0], slope[1]);
  const double a = smooth.angle(), time = 0.4, fall = 0.5 * 9.81 * time * time;
  const auto free = smooth.slid(time), braked = rough.slid(time);
  CHECK(free[0] == Approx(fall * std::sin(a)).epsilon(0.005));
  CHECK(std::abs(free[1]) < 0.005 * free[0]);
  CHECK(braked[0] == Approx(fall * (std::sin(a) - 0.15 * std::cos(a))).epsilon(0.02));
  CHECK(std::abs(braked[1]) < 0.02 * free[0]);
  const double early = TiltedBlock{slope, 2.0}.slid(0.2)[0];
  CHECK(early < 0.01);
  CHECK(TiltedBlock{slope, 2.0}.slid(0.4)[0] < early + 0.002);
}

TEST_CASE("A lump of soil swings in a bowl, or comes to rest in it", "[mpm]") {
  // z = r^2 / 2R: without friction x = x0 cos(t sqrt(g/R)) while slopes are small.
  const double radius = 25.0, start = 1.5, period = 2.0 * kPi * std::sqrt(radius / 9.81);
  ParticleSet p;
  p.materials = {elastic(5e6, 0.3)};
  const double bottom = start * start / (2.0 * radius);
  add_block(p, {{start - 0.5, -0.5, bottom}, {start + 0.5, 0.5, bottom + 0.5}}, 0.125, 1800.0);
  for (auto& x : p.position) x[2] += (x[0] - start) * start / radius;
  FlowConfig config = free_space(0.25);
  config.gravity = 9.81;
  const auto middle_after = [&](double friction, double time, double& speed) {
    Simulation<3> s = make_simulation<3>(p, config);
    s.ground.friction = friction;
    s.ground.field =
        sampled(6.0, 0.4, [&](double x, double y) { return (x * x + y * y) / (2.0 * radius); });
    StepScratch<3> scratch(1);
    prepare(s, scratch, true);
    while (s.time < time) advance(s, scratch);
    double x = 0.0, v = 0.0;
    for (std::size_t q = 0; q < s.points.size(); ++q) {
      x += s.points.x[0][q] / double(s.points.size());
      v += s.points.v[0][q] / double(s.points.size());
    }
    speed = v;
    return x;
  };
  double speed = 0.0;
  CHECK(middle_after(0.0, 0.25 * period, speed) == Approx(0.0).margin(0.03 * start));
  CHECK(speed == Approx(-start * std::sqrt(9.81 / radius)).epsilon(0.03));
  // tan of the steepest slope under the lump is 0.08: it sticks at 0.15.
  CHECK(middle_after(0.15, 0.25 * period, speed) == Approx(start).margin(0.01));
  CHECK(std::abs(speed) < 0.01);
}

TEST_CASE("A terrain that is no file, or that cannot be in its file, is refused at once", "[mpm]") {
  const Scratch folder;
  REQUIRE(::mkfifo((folder / "pipe").c_str(), 0600) == 0);
  CHECK_THROWS_AS(read_height_field(folder / "pipe", {}), FileError);
  CHECK_THROWS_AS(read_height_field("/dev/zero", {}), FileError);
  const auto error = [&](const std::string& text) {
    return input_error([&] { read_height_field(folder.write("valley.asc", text), {}); });
  };
  CHECK_THAT(error("ncols 100000\nnrows 100000\nxllcorner 0\nyllcorner 0\ncellsize 1\n1 2 3\n"),
             Contains("too short for so many"));
  CHECK_THAT(error("ncols 2\n" + std::string(5u << 20u, '1')),
             Contains("valley.asc:2") && Contains("more than 4 MiB"));
}

TEST_CASE("A terrain that is no plain text is named as such", "[mpm]") {
  using namespace std::string_literals;
  std::string wide = "\xFF\xFE";
  for (const char c : std::string(kGrid)) wide += {c, '\0'};
  for (const std::string& bytes : {"II*\0\x08\0\0\0"s, "\0\x10\0\x10"s, "PK\x03\x04"s, wide})
    CHECK_THROWS_WITH(read_text(bytes), Contains("valley.asc: holds control characters (a binary "
                                                 "grid such as GeoTIFF, an archive or UTF-16"));
  CHECK(read_text("\xEF\xBB\xBF"s + kGrid).at(105.0, 55.0) == 9.0);
}
