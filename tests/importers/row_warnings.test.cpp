#include "importers/row_warnings.hpp"

#include "core/check.hpp"
#include "small_model.hpp"

#include <catch2/catch.hpp>
#include <fmt/format.h>

using namespace flowslide;
using Catch::Contains;
using flowslide::test::SmallModel;

namespace {

std::vector<double> times(int rows, double step) {
  std::vector<double> t;
  for (int i = 1; i <= rows; ++i) t.push_back(step * i);
  return t;
}

std::string warnings_of(const std::vector<FileTimes>& files) {
  return fmt::format("{}",
                     fmt::join(row_warnings(files, align_rows(files, StageChoice::only)), "\n"));
}

std::string joined(const std::vector<std::string>& warnings) {
  return fmt::format("{}", fmt::join(warnings, "\n"));
}

}  // namespace

TEST_CASE("rows lost in the middle of a recorder are told, thinned recorders are not",
          "[importers]") {
  const FileTimes whole{"displacement.out", times(20, 0.5)};
  FileTimes hole{"stress.out", whole.times};
  CHECK(warnings_of({whole, hole}).empty());
  hole.times.erase(hole.times.begin() + 8);
  CHECK(warnings_of({whole, hole}) ==
        "stress.out has no row between 4 and 5 s, where displacement.out has 1: those are not "
        "used. Was the file damaged, or put together from two runs?");
  hole.times.erase(hole.times.begin() + 8, hole.times.begin() + 11);
  CHECK_THAT(warnings_of({whole, hole}),
             Contains("stress.out has no row between 4 and 6.5 s, where displacement.out has 4"));

  CHECK(warnings_of({whole, {"stress.out", times(10, 1.0)}}).empty());
  // Thinned from steps that do not divide its own: it ends before the others, by less than a row.
  CHECK(
      warnings_of({{"displacement.out", times(21, 0.5)}, {"stress.out", times(10, 1.0)}}).empty());
}

TEST_CASE("a recorder that lost its last row ends early", "[importers]") {
  const FileTimes whole{"displacement.out", times(20, 0.5)}, torn{"stress.out", times(19, 0.5)};
  CHECK_THAT(warnings_of({whole, torn}), Contains("stress.out ends at 9.5 s, others at 10 s"));
  SmallModel model;
  model.folder.write("strain.out", SmallModel::strain_rows(1, 3) + "0.75 1 2");
  CHECK_THAT(joined(model.run_import().warnings), Contains("strain.out ends at 0.5 s"));
}

TEST_CASE("times in another unit are warned about", "[importers]") {
  SmallModel model;
  model.config.units.time = "ms";
  CHECK_THAT(joined(model.run_import().warnings),
             Contains("the shaking lasts 0.0005 s. Is `units.time` right?"));
  CHECK(joined(preview_opensees(model.config).warnings) == joined(model.run_import().warnings));
  const FileTimes in_ms{"stress.out", times(1000, 100.0)};
  CHECK_THAT(warnings_of({in_ms}), Contains("the shaking lasts 9.99e+04 s"));
}

TEST_CASE("velocities are held against displacements", "[importers]") {
  // 0.01 m in each row of 0.25 s are 0.04 m/s.
  const auto with = [](double speed) {
    SmallModel model;
    model.folder.write("velocity.out", SmallModel::rows(1, 4, 12, [speed](int i, int) {
                         return i % 2 ? 0.0 : speed;
                       }));
    model.folder.write("displacement.out", SmallModel::rows(1, 4, 12, [](int i, int r) {
                         return i % 2 ? 0.0 : 0.01 * r;
                       }));
    const std::string warnings = joined(model.run_import().warnings);
    CHECK(joined(preview_opensees(model.config).warnings) == warnings);
    return warnings;
  };
  CHECK(with(0.04).empty());
  CHECK(with(0.4).empty());
  CHECK_THAT(with(40.0), Contains("nodes move by 0.02 m in all, but their velocity would carry "
                                  "them 20 m"));
  CHECK_THAT(with(4e-5), Contains("would carry them 2e-05 m"));
}

TEST_CASE("a look at small files finds what the motion shows", "[importers]") {
  SmallModel model;
  model.folder.write("porePressure.out", SmallModel::rows(1, 4, 6, [](int i, int r) {
                       return -SmallModel::pressure(1 + i, r);
                     }));
  CHECK_THAT(joined(preview_opensees(model.config).warnings),
             Contains("pore pressure differs from gravity by 200 % on average"));
  model.folder.write("displacement.out",
                     SmallModel::rows(1, 4, 12, [](int, int r) { return 1e3 * r; }));
  CHECK_THROWS_WITH(preview_opensees(model.config), Contains("farther than the section is long"));
}
