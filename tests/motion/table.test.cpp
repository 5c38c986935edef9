#include "motion/table.hpp"

#include "core/check.hpp"
#include "motion/process.hpp"
#include "motion/write_motion.hpp"
#include "signals.hpp"

#include <array>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

using namespace flowslide;
using Catch::Contains;
using flowslide::test::DataFolder;
using flowslide::test::sampled;

TEST_CASE("a record is measured, velocity and spectrum after scaling", "[motion]") {
  const DataFolder folder;
  const GroundMotion motion =
      sampled(0.01, 15.0, [](double t) { return 2.0 * std::exp(-0.3 * t) * std::sin(12.0 * t); });
  write_motion(folder.path("m.csv"), motion);
  const RecordFormat format{.unit = "m/s2"};
  const double target = 0.3 * kGravity;
  const MotionRow row = measure_record(folder.path("m.csv"), target, format);
  const MotionMeasures as_recorded = measure(motion);
  const MotionMeasures scaled = measure(scaled_to_pga(motion, target));
  CHECK(row.npts == 1501);
  CHECK(row.measures.pga == as_recorded.pga);
  CHECK(row.measures.arias == as_recorded.arias);
  CHECK(row.measures.pgv == Approx(scaled.pgv).epsilon(1e-12));
  CHECK(row.measures.masi == Approx(scaled.masi).epsilon(1e-12));
  CHECK(measure_record(folder.path("m.csv"), {}, format).measures.pgv == as_recorded.pgv);

  const auto json = nlohmann::ordered_json::parse(motion_json(std::array{row}));
  REQUIRE(json.size() == 1);
  std::vector<std::string> keys;
  for (const auto& [key, value] : json[0].items()) keys.push_back(key);
  CHECK(keys == std::vector<std::string>{"file", "npts", "dt_s", "pga_g", "arias_m_s", "d5_95_s",
                                         "tm_s", "pgv_cm_s", "masi_m_s"});
  CHECK(json[0]["file"] == folder.path("m.csv").string());
  CHECK(json[0]["pga_g"].get<double>() == Approx(as_recorded.pga / kGravity));
  CHECK(json[0]["pgv_cm_s"].get<double>() == Approx(100.0 * scaled.pgv));
  CHECK(json[0]["masi_m_s"].get<double>() == Approx(scaled.masi));

  const std::string table = motion_table(std::array{row}, target);
  CHECK_THAT(table, Contains("1501") && Contains(fmt::format("{:.2f}", 100.0 * scaled.pgv)) &&
                        Contains("scaling to 0.3 g"));
  CHECK_THAT(motion_table(std::array{row}), !Contains("scaling"));
}

TEST_CASE("no records give an empty list", "[motion]") { CHECK(motion_json({}) == "[]"); }

TEST_CASE("a wanted peak must be positive", "[motion]") {
  CHECK_THROWS_AS(measure_record("none.AT2", 0.0), InputError);
  CHECK_THROWS_AS(measure_record("none.AT2", kUnset), InputError);
  CHECK_THROWS_AS(measure_record("none.AT2", 1.0), FileError);
}
