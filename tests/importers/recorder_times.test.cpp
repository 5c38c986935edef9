#include "importers/recorder_times.hpp"

#include "core/check.hpp"

#include <catch2/catch.hpp>

using namespace flowslide;
using Catch::Contains;

namespace {
using Indices = std::vector<std::size_t>;
}

TEST_CASE("rows are matched by time, not by number", "[importers]") {
  const std::vector<FileTimes> files = {
      {"a.out", {0.1, 0.2, 0.3, 0.4}}, {"b.out", {0.2, 0.4, 0.5}}, {"c.out", {0.2, 0.25, 0.4}}};
  const AlignedRows aligned = align_rows(files, StageChoice::only);
  CHECK(aligned.times == std::vector<double>{0.2, 0.4});
  CHECK(aligned.rows == std::vector<Indices>{{1, 3}, {0, 1}, {0, 2}});
  CHECK(aligned.notes == std::vector<std::string>{
                             "a.out: 2 of 4 rows are at times that another file lacks, not used",
                             "b.out: 1 of 3 rows are at times that another file lacks, not used",
                             "c.out: 1 of 3 rows are at times that another file lacks, not used"});
}

TEST_CASE("times printed with different digits are the same time", "[importers]") {
  const std::vector<FileTimes> files = {{"a.out", {123.457, 123.707}},
                                        {"b.out", {123.45678, 123.70678}}};
  CHECK(align_rows(files, StageChoice::only).times == std::vector<double>{123.457, 123.707});
  // Steps near the printed resolution must not merge neighbours.
  const std::vector<FileTimes> fine = {{"a.out", {100.000, 100.001}}, {"b.out", {100.001}}};
  CHECK(align_rows(fine, StageChoice::only).rows == std::vector<Indices>{{1}, {0}});
}

TEST_CASE("where time goes back a stage must be chosen", "[importers]") {
  const std::vector<FileTimes> files = {{"a.out", {0.1, 0.5, 0.1, 0.2, 0.3}},
                                        {"b.out", {0.1, 0.2, 0.3}}};
  CHECK_THROWS_AS(align_rows(files, StageChoice::only), InputError);
  CHECK_THROWS_WITH(align_rows(files, StageChoice::only),
                    Contains("a.out: time goes back, 2 stages (gravity and shaking in one file?): "
                             "0.1 to 0.5 in 2 rows, 0.1 to 0.3 in 3 rows") &&
                        Contains("`stage: last`"));
  const AlignedRows last = align_rows(files, StageChoice::last);
  CHECK(last.rows == std::vector<Indices>{{2, 3, 4}, {0, 1, 2}});
  CHECK(last.notes.size() == 1);
  CHECK(align_rows(files, StageChoice::first).rows == std::vector<Indices>{{0}, {0}});
}

TEST_CASE("of repeated times the last row counts", "[importers]") {
  const std::vector<FileTimes> files = {{"a.out", {0.1, 0.2, 0.2, 0.2, 0.3}}};
  const AlignedRows aligned = align_rows(files, StageChoice::only);
  CHECK(aligned.rows == std::vector<Indices>{{0, 3, 4}});
  CHECK(aligned.notes ==
        std::vector<std::string>{"a.out: 2 rows repeat the time of the row after them, dropped"});
}

TEST_CASE("recorders without a common time are refused", "[importers]") {
  const std::vector<FileTimes> files = {{"a.out", {0.1, 0.2}}, {"b.out", {1.1, 1.2}}};
  CHECK_THROWS_WITH(align_rows(files, StageChoice::only),
                    Contains("no time in common (a.out 0.1 to 0.2, b.out 1.1 to 1.2)"));
}

TEST_CASE("steps are reported over increasing times only", "[importers]") {
  const StepRange r = step_range(std::vector<double>{0.0, 0.25, 0.75, 0.1, 0.1, 0.2});
  CHECK(r.min == Approx(0.1));
  CHECK(r.max == 0.5);
  CHECK(step_range(std::vector<double>{3.0}).max == 0.0);
}
