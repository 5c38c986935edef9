#include "motion/foreign.hpp"

#include "core/check.hpp"
#include "core/conventions.hpp"
#include "motion/record.hpp"

#include <cmath>

#include <catch2/catch.hpp>

using namespace flowslide;
using Catch::Contains;

namespace {

std::string message(const std::string& text, const RecordFormat& format = {.unit = "cm/s2"}) {
  try {
    parse_record(text, "a.txt", format);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

const std::string kValues = "     100    -200     300    -400     500    -600     700    -800\n";

}  // namespace

TEST_CASE("Formats of records that are not read are named by their header", "[motion]") {
  const std::string knet =
      "Origin Time       2001/01/01 00:00:00\nLat.              35.000\n"
      "Sampling Freq(Hz) 100Hz\nDuration Time(s)  4\nScale Factor      3920(gal)/6182761\n"
      "Memo.             \n" +
      kValues;
  CHECK_THAT(message(knet), Contains("format K-NET or KiK-net") && Contains("scale factor"));
  // The advice that used to lead to a wrong record must not help either.
  CHECK_THAT(message(knet, {.unit = "cm/s2", .dt = 0.01, .acceleration_column = 1}),
             Contains("K-NET"));
  CHECK_THAT(message("#origin_time,2001/01/01\n#sampling_freq,100Hz\n#time,NS\n0,1\n1,2\n", {}),
             Contains("K-NET CSV"));
  CHECK_THAT(message("Corrected acceleration  X  (Format v01.20 with 13 text lines)\n"
                     " 100 Integer-header values follow on  10 lines, Format= (10I8)\n" +
                         kValues,
                     {}),
             Contains("COSMOS"));
  CHECK_THAT(message("CORRECTED ACCELEROGRAM\ntext\n" + kValues, {}), Contains("CSMIP"));
  CHECK_THAT(message("2 CORRECTED ACCELEROGRAM\n*\n" + kValues, {}), Contains("format SMC"));
  CHECK_THAT(message("EVENT_NAME: X\nSAMPLING_INTERVAL_S: 0.005\nUNITS: cm/s^2\n" + kValues, {}),
             Contains("format ESM"));
}

TEST_CASE("Columns and AT2 files are no foreign formats", "[motion]") {
  CHECK(message("# scale factor 2, origin time 12:00\n0 1\n0.01 2\n0.02 -3\n").empty());
  CHECK(message("PEER\nCORRECTED ACCELEROGRAM of X\nACCELERATION IN UNITS OF G\n"
                "NPTS= 3, DT= .01 SEC\n.1 -.2 .3\n",
                {})
            .empty());
}

TEST_CASE("Peaks that no earthquake has are warned about", "[motion]") {
  const auto warnings = [](const std::string& peak, const char* unit) {
    const Record r = parse_record("0 0\n0.01 " + peak + "\n0.02 0\n", "a.txt", {.unit = unit});
    return r.warnings.empty() ? std::string() : r.warnings.front();
  };
  CHECK_THAT(warnings("281", "g"), Contains("281 g"));
  CHECK_THAT(warnings("3.2", "g"), Contains("a.txt: the peak is 3.2 g"));
  CHECK_THAT(warnings("2.2", "g"), Contains("exceeds 2 g"));
  CHECK(warnings("1.9", "g").empty());
  CHECK(warnings("281", "cm/s2").empty());
  CHECK_THAT(warnings("0.3", "cm/s2"), Contains("nobody would feel"));
}

TEST_CASE("An acceleration with an offset is told by its velocity", "[motion]") {
  const auto told = [](double offset) {
    GroundMotion m;
    m.dt = 0.01;
    for (int i = 0; i <= 1000; ++i)
      m.acceleration.push_back(offset + std::sin(0.02 * kPi * i));  // ten times 1 s
    return implausible_velocity("a.txt", m);
  };
  CHECK(told(0.0).empty());
  CHECK(told(0.4).empty());
  CHECK_THAT(told(1.0), Contains("a.txt: the velocity reaches 10") && Contains("ends at 10 m/s"));
}

TEST_CASE("A time in milliseconds is warned about", "[motion]") {
  const auto warnings = [](const std::string& step) {
    return parse_record("0.1\n0.2\n", "a.txt", {.unit = "g", .dt = std::stod(step)}).warnings;
  };
  CHECK(warnings("0.02").empty());
  REQUIRE(warnings("10").size() == 1);
  CHECK_THAT(warnings("10").front(), Contains("a.txt: the time step is 10 s"));
  CHECK_THAT(warnings("1e-5").front(), Contains("unit of time"));
}

TEST_CASE("Decimal commas and odd blanks in records are named", "[motion]") {
  CHECK_THAT(message("0,00 0,1\n0,01 0,2\n"), Contains("a.txt:1") && Contains("decimal commas"));
  CHECK_THAT(message("0,00;0,1\n0,01;0,2\n"), Contains("decimal commas"));
  CHECK_THAT(message("0\xC2\xA0"
                     "1\n1 2\n"),
             Contains("non-breaking space"));
  CHECK(message("0,1\n0.5,2\n1.0,-3\n").empty());  // control: commas that separate
  CHECK(message("0.0, 1, 2\n0.5, 2, 1\n", {.unit = "g", .time_column = 1, .acceleration_column = 2})
            .empty());
}
