#include "motion/at2.hpp"

#include "core/check.hpp"
#include "signals.hpp"

#include <cstring>

#include <catch2/catch.hpp>

using namespace flowslide;
using Catch::Contains;
using flowslide::test::DataFolder;

namespace {

const std::vector<double> kValues{0.1, -0.25, 0.5e-3, -0.125, 0.2, -0.3, 0.05};

const std::string kUnits = "ACCELERATION TIME SERIES IN UNITS OF G";
const std::string kCounts = "NPTS=   7, DT=   .0200 SEC,";
const std::string kData =
    "  .1000000E+00  -.2500000E+00   .5000000E-03  -.1250000E+00   .2000000E+00\n"
    "  -.3000000E+00   .5000000E-01\n";

std::string at2(const std::string& units, const std::string& counts, const std::string& data) {
  return "PEER NGA STRONG MOTION DATABASE RECORD\nSomewhere, 1/2/1999, G Station DT 360\n" + units +
         "\n" + counts + "\n" + data;
}

void check_values(const Record& record, double to_si) {
  CHECK(record.motion.dt == 0.02);
  REQUIRE(record.motion.acceleration.size() == kValues.size());
  for (std::size_t i = 0; i < kValues.size(); ++i)
    CHECK(record.motion.acceleration[i] == kValues[i] * to_si);
}

std::string message(const std::string& text, const RecordFormat& format = {}) {
  try {
    parse_record(text, "a.AT2", format);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size())
    text.replace(at, from.size(), to);
  return text;
}

}  // namespace

TEST_CASE("AT2 headers in every order", "[motion]") {
  const std::string counts = GENERATE(
      "NPTS=   7, DT=   .0200 SEC,", "NPTS=  7, DT= .02000 SEC", "NPTS=      7, dt=   .0200 SEC",
      "NPTS= 7 DT= .02 SEC", "NPTS=7,DT=.02SEC", "npts = 7 , dt = 0.02 sec", "NPTS: 7  DT: 0.02",
      "DT= .0200 SEC, NPTS= 7", "DT=0.02 NPTS=7", "7   .0200   NPTS, DT", "7 0.02 NPTS, DT (SEC)",
      "   .0200   7   DT, NPTS", "NPTS, DT: 7, .02", "NPTS, DT = 7 .0200", "NPTS 7 DT .02",
      "NPTS=    7, DT= 2.0E-02 SEC", "NPTS= 7, DT= 2.D-02 SEC", "NPTS=7DT=.02",
      "NPTS=   7\nDT=   .0200 SEC", "DT= .02\nNPTS= 7", "NPTS= 7.0, DT= +.02");
  CAPTURE(counts);
  check_values(parse_record(at2(kUnits, counts, kData), "a.AT2"), kGravity);
}

TEST_CASE("AT2 units as headers state them", "[motion]") {
  const auto& [units, to_si] = GENERATE(table<std::string, double>(
      {{"ACCELERATION TIME HISTORY IN UNITS OF G. FILTER POINTS: HP=0.1 Hz LP=40.0 Hz", kGravity},
       {"ACCELERATION TIME SERIES IN UNITS OF g", kGravity},
       {"ACCELERATION IN UNITS OF G'S", kGravity},
       {"Acceleration (g)", kGravity},
       {"ACCELERATION TIME SERIES IN UNITS OF CM/S/S", 0.01},
       {"ACCELERATION TIME SERIES IN UNITS OF CM/SEC**2", 0.01},
       {"ACCELERATION, UNITS: CM / SEC ** 2", 0.01},
       {"ACCELERATION TIME SERIES IN CM/SEC/SEC", 0.01},
       {"ACCELERATION IN UNITS OF cm/s2", 0.01},
       {"ACCELERATION IN UNITS OF CM/S^2, FILTERED", 0.01},
       {"CORRECTED ACCELERATION (GAL)", 0.01},
       {"ACCELERATION IN UNITS OF M/S**2", 1.0},
       {"ACCELERATION IN UNITS OF M/SEC2", 1.0}}));
  CAPTURE(units);
  check_values(parse_record(at2(units, kCounts, kData), "a.AT2"), to_si);
}

TEST_CASE("the unit may stand with the counts, or be declared", "[motion]") {
  check_values(parse_record(at2("ACCELERATION", kCounts + " UNITS= CM/S2", kData), "a.AT2"), 0.01);
  check_values(parse_record(at2("ACCELERATION", kCounts, kData), "a.AT2", {.unit = "cm/s2"}), 0.01);
  // What the header states is not overruled.
  check_values(parse_record(at2(kUnits, kCounts, kData), "a.AT2", {.unit = "g"}), kGravity);
  CHECK_THAT(message(at2(kUnits, kCounts, kData), {.unit = "cm/s2"}),
             Contains("a.AT2:3: the header says g, but `unit` is cm/s2"));
  CHECK_THAT(message(at2("ACCELERATION", kCounts, kData)), Contains("does not state the unit"));
}

TEST_CASE("AT2 values in every layout", "[motion]") {
  const std::string text = at2(kUnits, kCounts, kData);
  SECTION("CRLF") { check_values(parse_record(replaced(text, "\n", "\r\n"), "a"), kGravity); }
  SECTION("CR") { check_values(parse_record(replaced(text, "\n", "\r"), "a"), kGravity); }
  SECTION("no newline at the end") {
    check_values(parse_record(text.substr(0, text.size() - 1), "a"), kGravity);
  }
  SECTION("Ctrl-Z and blank lines at the end") {
    check_values(parse_record(text + "\n  \n\x1A", "a"), kGravity);
  }
  SECTION("byte order mark") { check_values(parse_record("\xEF\xBB\xBF" + text, "a"), kGravity); }
  SECTION("one value to a line") {
    check_values(
        parse_record(at2(kUnits, kCounts, "0.1\n-0.25\n0.0005\n-.125\n.2\n-.3\n.05\n"), "a"),
        kGravity);
  }
  SECTION("lines wrapped anywhere, commas, tabs, Fortran exponents") {
    check_values(
        parse_record(at2(kUnits, kCounts, "1.D-1, -2.5D-1,5.0d-04\n\n\t-.125\t+.2 -.3\n 5E-02\n"),
                     "a"),
        kGravity);
  }
  SECTION("fixed-width columns that touch") {
    check_values(parse_record(at2(kUnits, kCounts,
                                  "0.100000E+00-0.250000E+00 0.500000E-03-0.125000E+00\n"
                                  ".2-.3+.05\n"),
                              "a"),
                 kGravity);
  }
}

TEST_CASE("AT2 files on disk, plain and gzip", "[motion]") {
  const DataFolder folder;
  const std::string text = at2(kUnits, kCounts, kData);
  const Record plain = read_record(folder.write("a.AT2", text));
  check_values(plain, kGravity);
  CHECK(plain.motion.origin == "a.AT2 (Somewhere, 1/2/1999, G Station DT 360)");
  check_values(read_record(folder.write_gzip("a.AT2.gz", text)), kGravity);

  CHECK_THROWS_AS(read_record(folder.path("none.AT2")), FileError);
  CHECK_THROWS_AS(read_record(folder.path(".")), FileError);
  std::string cut(60000, ' ');
  for (std::size_t i = 0; i < cut.size(); ++i) cut[i] = static_cast<char>('0' + (i * i / 7) % 10);
  const auto gz = folder.write_gzip("cut.gz", cut);
  std::filesystem::resize_file(gz, std::filesystem::file_size(gz) / 2);
  CHECK_THROWS_WITH(read_record(gz), Contains("gzip data end too early"));
}

TEST_CASE("the number of AT2 values is held against NPTS", "[motion]") {
  const std::string fewer = at2(kUnits, "NPTS= 9, DT= .02 SEC", kData);
  CHECK_THAT(message(fewer), Contains("7 values, but NPTS is 9") && Contains("cut"));
  const Record taken = parse_record(fewer, "a.AT2", {.accept_count = true});
  check_values(taken, kGravity);
  REQUIRE(taken.notes.size() == 1);
  CHECK_THAT(taken.notes[0], Contains("the values of the file were used"));

  // The last line is filled up with zeros.
  const Record filled = parse_record(
      at2(kUnits, kCounts, replaced(kData, ".5000000E-01", ".5000000E-01 0.0 0.0 0.0")), "a.AT2");
  check_values(filled, kGravity);
  REQUIRE(filled.notes.size() == 1);
  CHECK_THAT(filled.notes[0], Contains("10 values, but NPTS is 7"));

  const std::string twice = at2(kUnits, kCounts, kData + kData);
  CHECK_THAT(message(twice), Contains("14 values, but NPTS is 7") && Contains("second record"));
  CHECK(parse_record(twice, "a", {.accept_count = true}).motion.acceleration.size() == 14);
}

TEST_CASE("AT2 files that cannot be meant are refused with their line", "[motion]") {
  const auto with = [](const std::string& counts) { return message(at2(kUnits, counts, kData)); };
  CHECK_THAT(with("NPTS= 7"), Contains("a.AT2:4: NPTS without DT"));
  CHECK_THAT(with("NPTS= , DT= SEC"), Contains("does not give both NPTS and DT"));
  CHECK_THAT(with("NPTS= 7, DT= 50 SEC"), Contains("DT is 50 s") && Contains("sampling rate"));
  CHECK_THAT(with("NPTS= 7, DT= 0.0 SEC"), Contains("DT is 0 s"));
  CHECK_THAT(with("NPTS= 7, DT= -.02 SEC"), Contains("DT is -0.02 s"));
  CHECK_THAT(with("NPTS= 7.5, DT= .02 SEC"), Contains("NPTS is 7.5"));
  CHECK_THAT(with("NPTS= 0, DT= .02 SEC"), Contains("NPTS is 0"));
  for (const char* dt : {".02.0", "0,02"})
    CHECK_THAT(with("NPTS= 7, DT= " + std::string(dt) + " SEC"),
               Contains("a.AT2:4: '" + std::string(dt) + "' after DT is no number"));
  CHECK_THAT(message(at2("VELOCITY TIME SERIES IN UNITS OF CM/S", kCounts, kData)),
             Contains("a.AT2:3") && Contains("velocity or displacement"));
  CHECK_THAT(message(at2("TIME SERIES IN UNITS OF CM", kCounts, kData)),
             Contains("no unit of acceleration"));
  const auto data = [](const std::string& text) { return message(at2(kUnits, kCounts, text)); };
  CHECK_THAT(data("0.1 0.2\n0.3 nan 0.5\n"), Contains("a.AT2:6: value 2 'nan'"));
  CHECK_THAT(data("0.1 ******** 0.3\n"), Contains("a.AT2:5: value 2 '********'"));
  CHECK_THAT(data("0.1 0.2x 0.3\n"), Contains("value 2 '0.2x'"));
  CHECK_THAT(data("0.1 1e999 0.3\n"), Contains("value 2 '1e999'"));
  CHECK_THAT(data("0 0 0 0 0 0 0\n"), Contains("every acceleration is zero"));
  CHECK_THAT(message(""), Contains("is empty"));
  const std::size_t whole = kData.rfind("E-01\n");
  for (const std::size_t left : {whole, whole - 3})
    CHECK_THAT(data(kData.substr(0, left)), Contains("a.AT2:6: the last value has no exponent"));
  CHECK(data(replaced(kData, "E-01\n", "E-01")) == "no error");
  CHECK(data("1e-1 2e-1 .3 4e-1 .5 6e-1 7\n") == "no error");
  CHECK_THAT(message(std::string("NPTS\0= 7", 8)), Contains("control characters"));
}
