#include "study/table/analysis.hpp"
#include "tests/study/study_bench.hpp"

#include <nlohmann/json.hpp>

using namespace flowslide;
using namespace flowslide::study;
using namespace flowslide::study::sample;
using Catch::Contains;

namespace {

/// one 1..4 crossed with factor 1, 2 and three repeats: sum = factor * (one + 2), its factor disturbed
/// by a thousandth.
const std::string kStudy =
    "  set: {stages.count.with.steps: 1, stages.sum.with.factor: 1}\n"
    "  vary:\n"
    "    one: {setting: stages.one.with.value, values: [1, 2, 3, 4]}\n"
    "    factor: {setting: stages.sum.with.factor, values: [1, 2]}\n"
    "  repeat: {count: 3, scale: {stages.sum.with.factor: 1e-3}}\n"
    "  also:\n    half: {set: {stages.sum.with.factor: 0.5}, "
    "vary: {one: {setting: stages.one.with.value, values: [1, 2]}}}\n"
    "  analysis: {results: [sum], thresholds: [[one, sum]]}\n";

}  // namespace

TEST_CASE("Table and analysis of a study whose answer is known", "[study]") {
  StudyBench bench;
  const Plan plan = bench.plan(kStudy);
  bench.run(plan);
  const StudyState progress = bench.progress(plan);
  const Table table = make_table(plan, progress);
  REQUIRE(table.rows == 4 * 2 * 3 + 2);
  const Column* sum = table.find("sum");
  REQUIRE(sum);
  CHECK(sum->number[0] == 3.0);
  CHECK(sum->number[1] == Approx(3.003));
  CHECK(sum->number[2] == Approx(2.997));
  CHECK(table.find("factor")->number[3] == 2.0);
  CHECK(table.find("key:sum")->text[0].size() == 16);
  CHECK(table.find("disturbed:stages.sum.with.factor")->text[1] == "1.001");

  const StudyFindings f = analyse(plan, table);
  CHECK(f.variant == "base");
  CHECK(f.groups.size() == 8);
  // Three values s, s (1 + e), s (1 - e) have the deviation s e.
  CHECK(f.scatter[0].deviation[0] == Approx(3.0 * 1e-3).epsilon(1e-9));
  CHECK(f.scatter[0].repeated == 8);
  CHECK(f.scatter[0].of_inputs > 100.0 * f.scatter[0].numerical);
  REQUIRE(f.swings.size() == 2);
  CHECK(f.swings[1].input == "factor");
  CHECK(f.swings[1].effect.swing.value == Approx(4.5));
  const auto relation = std::find_if(f.relations.begin(), f.relations.end(),
                                     [](const Relation& r) { return r.x == "one"; });
  REQUIRE(relation != f.relations.end());
  CHECK(relation->line.slope.value == Approx(1.5));
  CHECK(relation->spearman.value > 0.5);
  REQUIRE(f.thresholds.size() == 1);
  // base over half, at one 1 and 2 and together
  REQUIRE(f.comparisons.size() == 3);
  CHECK(f.comparisons[0].where == "one 1");
  CHECK(f.comparisons[0].ratio.value == Approx(3.0));
  CHECK(f.comparisons[2].where == "");

  const auto json = nlohmann::json::parse(to_json_text(plan, f));
  CHECK(json["results"][0]["numerical_scatter"].get<double>() == f.scatter[0].numerical);
  CHECK(json["relations"].size() == f.relations.size());
}

TEST_CASE("The page of a study is one file that asks nothing of the network", "[study]") {
  StudyBench bench;
  const Plan plan = bench.plan(kStudy + "  keep: numbers\n");
  bench.run(plan);
  const Table table = make_table(plan, bench.progress(plan));
  write_tables(bench.folder, plan, table);
  write_page(bench.folder, plan, table);
  const std::string html = read_text_file(bench.folder / "study.html");
  CHECK_THAT(html, Contains("numerical scatter") && Contains("<svg") && Contains("prefers-color-scheme"));
  for (const char* outside : {"http://", "https://", "<script", "<link", "url("})
    CHECK_THAT(html, !Contains(outside));
  CHECK(read_text_file(bench.folder / "table.csv") == to_csv(table));
  CHECK_THAT(read_text_file(bench.folder / "columns.csv"),
             Contains("one,,input,stages.one.with.value") && Contains("sum,,found,sum (sample.sum)"));
  CHECK(std::filesystem::exists(bench.folder / "table.h5"));
  CHECK_THAT(read_text_file(bench.folder / "figures/sum-tornado.svg"),
             Contains("xmlns='http://www.w3.org/2000/svg'"));
}

TEST_CASE("Numbers that hang on the machine are not in the table", "[study]") {
  StudyBench bench;
  const Plan plan = bench.plan("");
  bench.run(plan);
  const Table table = make_table(plan, bench.progress(plan));
  for (const Column& c : table.columns) CHECK(c.name.find("seconds") == std::string::npos);
  CHECK(unit_in_name("runout_m") == "m");
  CHECK(unit_in_name("volume_past_toe_m3_per_m") == "m3/m");
  CHECK(unit_in_name("motion_pga_m_s2") == "m/s2");
  CHECK(unit_in_name("particles") == "");
}

TEST_CASE("A column that is not there is refused by its name", "[study]") {
  StudyBench bench;
  const Plan plan = bench.plan("  analysis: {results: [runout]}\n");
  bench.run(plan);
  const Table table = make_table(plan, bench.progress(plan));
  CHECK_THROWS_WITH(analyse(plan, table), Contains("no column of numbers 'runout'"));
}
