#include "motion/columns.hpp"

#include "core/check.hpp"
#include "motion/write_motion.hpp"
#include "signals.hpp"
#include "tests/support/limited_files.hpp"

#include <sys/stat.h>

#include <catch2/catch.hpp>

using namespace flowslide;
using Catch::Contains;
using flowslide::test::DataFolder;
using flowslide::test::sampled;

namespace {

std::string message(const std::string& text, const RecordFormat& format) {
  try {
    parse_record(text, "a.csv", format);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

const std::vector<double> kExpected{0.1 * kGravity, -0.2 * kGravity, 0.3 * kGravity};

}  // namespace

TEST_CASE("one column needs its step and its unit", "[motion]") {
  const std::string text =
      GENERATE("0.1\n-0.2\n0.3\n", "acc\n0.1\n-.2\n+.3", "# g\r\n.1\r\n-.2\r\n.3\r\n");
  const Record record = parse_record(text, "a.csv", {.unit = "g", .dt = 0.01});
  CHECK(record.motion.dt == 0.01);
  CHECK(record.motion.acceleration == kExpected);
  CHECK_THAT(message(text, {.unit = "g"}), Contains("time step is not known"));
  CHECK_THAT(message(text, {.dt = 0.01}), Contains("unit of acceleration is not known"));
  CHECK_THAT(message(text, {.unit = "kPa", .dt = 0.01}), Contains("unit of stress"));
  CHECK_THAT(message(text, {.unit = "g", .dt = kUnset}), Contains("the time step is nan"));
}

TEST_CASE("two columns are time and acceleration", "[motion]") {
  const std::string text =
      GENERATE("0.00,0.1\n0.01,-0.2\n0.02,0.3\n", "time (s), acc (g)\n0;0.1\n0.01;-0.2\n0.02;0.3\n",
               "# t a\n5.00\t.1\n5.01\t-.2\n5.02\t.3\n");
  CAPTURE(text);
  const Record record = parse_record(text, "a.csv", {.unit = "g"});
  CHECK(record.motion.dt == Approx(0.01).epsilon(1e-12));
  CHECK(record.motion.acceleration == kExpected);
}

TEST_CASE("a heading with another unit than the setting is refused", "[motion]") {
  const std::string rows = "0,1\n0.01,-2\n0.02,3\n";
  for (const char* heading :
       {"time (s), acc (cm/s2)\n", "t,a[CM/SEC^2]\n", "# Acceleration in cm/s\u00b2\n",
        "time_s,acc_cm_s2\n", "Zeit; Beschleunigung (gal)\n", "# Units: cm/sec/sec\n"}) {
    CAPTURE(heading);
    CHECK_THAT(
        message(heading + rows, {.unit = "g"}),
        Contains("a.csv:1: the heading says cm/s2, but `unit` is g") && Contains("981 times"));
    CHECK_THAT(message(heading + rows, {}), Contains("give `unit: cm/s2`"));
    CHECK(message(heading + rows, {.unit = "cm/s2"}) == "no error");
  }
  for (const char* heading : {"time (s), acc (g)\n", "time,acc_g\n", "# in units of g\n"}) {
    CAPTURE(heading);
    CHECK_THAT(message(heading + rows, {.unit = "m/s2"}), Contains("the heading says g"));
    CHECK(message(heading + rows, {.unit = "g"}) == "no error");
  }
}

TEST_CASE("words in a heading that are no unit of the column count for nothing", "[motion]") {
  const std::string rows = "0,1\n0.01,-2\n0.02,3\n";
  for (const char* heading :
       {"# peak 0.3 g at Loma, 341.7 cm/s2 before scaling\n", "# (G. Smith, station GS)\n",
        "time (s), vel (cm/s)\n", "# in g or cm/s2, see the setting\n"})
    CHECK(message(heading + rows, {.unit = "m/s2"}) == "no error");
  // of three columns each has its own unit
  const std::string wide = "t (s), a (g), b (cm/s2)\n0,1,2\n0.01,1,2\n0.02,1,2\n";
  const RecordFormat second{.unit = "g", .time_column = 1, .acceleration_column = 2};
  CHECK(message(wide, second) == "no error");
  const RecordFormat third{.unit = "g", .time_column = 1, .acceleration_column = 3};
  CHECK_THAT(message(wide, third), Contains("the heading says cm/s2"));
}

TEST_CASE("records tell themselves from other tables by their heads", "[motion]") {
  const auto is = [](const std::string& text) { return is_record(record_text(text, "a")); };
  CHECK(is("PEER\nX\nACCELERATION IN UNITS OF G\nNPTS= 3, DT= .01 SEC\n.1 -.2 .3\n"));
  CHECK(is("Sampling Freq(Hz) 100Hz\nScale Factor 1(gal)/2\n 1 2 3 4 5 6 7 8\n"));
  CHECK(is("time,acc\n0,1\n"));
  CHECK(is("t a[cm/s2]\n0 1\n"));
  CHECK_FALSE(is("0.0 1 2\n0.1 3 4\n"));
  CHECK_FALSE(is("# node 17, vaccuum\n0.0 1 2\n"));
  CHECK(stated_unit(record_text("t a[cm/s2]\n0 1\n", "a")) == "cm/s2");
  CHECK_FALSE(stated_unit(record_text("t a\n0 1\n", "a")).has_value());
}

TEST_CASE("columns can be named", "[motion]") {
  const std::string text = "1 0.00 9 0.1\n2 0.01 9 -0.2\n3 0.02 9 0.3\n";
  CHECK_THAT(message(text, {.unit = "g"}),
             Contains("4 columns") && Contains("write one to a line"));
  const Record timed =
      parse_record(text, "a", {.unit = "g", .time_column = 2, .acceleration_column = 4});
  CHECK(timed.motion.acceleration == kExpected);
  CHECK(timed.motion.dt == Approx(0.01).epsilon(1e-12));
  const Record untimed =
      parse_record(text, "a", {.unit = "g", .dt = 0.5, .acceleration_column = 4});
  CHECK(untimed.motion.dt == 0.5);
  CHECK_THAT(message(text, {.unit = "g", .time_column = 5, .acceleration_column = 4}),
             Contains("the file has 4"));
  CHECK_THAT(message(text, {.unit = "g", .acceleration_column = -1}), Contains("counted from 1"));
}

TEST_CASE("times with few digits give the mean step", "[motion]") {
  std::string text;
  for (int i = 0; i <= 1280; ++i) text += fmt::format("{:.3f} {}\n", i / 128.0, i % 2 + 1);
  CHECK(parse_record(text, "a", {.unit = "m/s2"}).motion.dt == Approx(1.0 / 128.0).epsilon(1e-9));
  CHECK(parse_record(text, "a", {.unit = "m/s2", .dt = 0.0078125}).motion.dt == 0.0078125);
  CHECK_THAT(message(text, {.unit = "m/s2", .dt = 0.005}), Contains("0.005 s was declared"));
}

TEST_CASE("columns that are no uniform motion are refused", "[motion]") {
  const RecordFormat g{.unit = "g"};
  CHECK_THAT(message("0 1\n0.01 2\n0.03 3\n0.04 4\n", g),
             Contains("a.csv:3: a step of 0.02 s, but most are 0.01 s"));
  CHECK_THAT(message("0 1\n0.01 2\n0.01 2\n0.02 4\n", g), Contains("a.csv:3: a step of 0 s"));
  CHECK_THAT(message("0.02 1\n0.01 2\n0 3\n", g), Contains("does not increase"));
  CHECK_THAT(message("0 1\n0.01\n", g), Contains("a.csv:2: 1 columns"));
  CHECK_THAT(message("0 1\n0.01 x\n", g), Contains("a.csv:2: value 2 'x'"));
  CHECK_THAT(message("0 1\n", g), Contains("1 rows"));
  CHECK_THAT(message("time,acc\n", g), Contains("0 rows"));
}

TEST_CASE("a written motion reads back to the same numbers", "[motion]") {
  const DataFolder folder;
  const GroundMotion motion =
      sampled(0.005, 1.0, [](double t) { return std::exp(-t) * std::sin(40.0 * t) / 3.0; });
  write_motion(folder.path("m.csv"), motion);
  const Record back = read_record(folder.path("m.csv"), {.unit = "m/s2"});
  CHECK(back.motion.acceleration == motion.acceleration);
  CHECK(back.motion.dt == Approx(0.005).epsilon(1e-14));
  CHECK_THROWS_AS(write_motion(folder.path("none/m.csv"), motion), FileError);
}

TEST_CASE("a motion on a full disk is whole or not there", "[motion]") {
  const GroundMotion motion =
      sampled(0.005, 1.0, [](double t) { return std::sin(40.0 * t) / 3.0; });
  test::check_limited_files(
      [&](const std::filesystem::path& folder) { write_motion(folder / "m.csv", motion); }, 20);
}

TEST_CASE("a record that is no file is refused at once", "[motion]") {
  const DataFolder folder;
  REQUIRE(::mkfifo(folder.path("pipe").c_str(), 0600) == 0);
  CHECK_THROWS_AS(read_record(folder.path("pipe"), {}), FileError);
  CHECK_THROWS_AS(read_record("/dev/zero", {}), FileError);
}
