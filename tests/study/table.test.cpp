#include "study/page/chart.hpp"
#include "study/table/analysis.hpp"
#include "tests/study/study_bench.hpp"

#include <set>

#include <nlohmann/json.hpp>

using namespace flowslide;
using namespace flowslide::study;
using namespace flowslide::study::sample;
using Catch::Contains;

namespace {

/// one 1..4 crossed with factor 1, 2 and three repeats: sum = factor * (one + 2), its factor
/// disturbed by a thousandth.
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

TEST_CASE("Rows of another input lie on a ramp of their own", "[study]") {
  StudyBench bench;
  const Plan plan = bench.plan(
      "  vary:\n"
      "    one: {setting: stages.one.with.value, range: {from: 1, to: 9, step: 1}}\n"
      "    factor: {setting: stages.sum.with.factor, values: [2, 1]}\n"
      "  analysis: {results: [sum], thresholds: [[one, sum]]}\n");
  bench.run(plan);
  const Table table = make_table(plan, bench.progress(plan));
  const StudyFindings f = analyse(plan, table);
  REQUIRE(f.thresholds.size() == 2);
  CHECK(f.thresholds[0].where == "factor 1");
  CHECK(f.thresholds[1].where == "factor 2");
  CHECK(f.thresholds[1].by == "factor");
  CHECK(table.find("factor")->number[f.thresholds[1].row] == 2.0);
  CHECK(f.thresholds[1].ramp.plateau.value == Approx(2.0 * f.thresholds[0].ramp.plateau.value));
  // The control: all rows on one ramp, which neither of them follows.
  std::vector<double> x, y;
  for (std::size_t i = 0; i < table.rows; ++i) {
    x.push_back(table.find("one")->number[i]);
    y.push_back(table.find("sum")->number[i]);
  }
  CHECK(fit_ramp(x, y, 1).r2 < f.thresholds[0].ramp.r2 - 0.1);
  const Page page = make_page(plan, table, f);
  CHECK_THAT(page.html, Contains("one, factor 1: "));
  CHECK_THAT(page.html, Contains("class='fit f1'"));
}

TEST_CASE("The page of a study is one file that asks nothing of the network", "[study]") {
  StudyBench bench;
  const Plan plan = bench.plan(kStudy + "  keep: numbers\n");
  bench.run(plan);
  const Table table = make_table(plan, bench.progress(plan));
  write_tables(bench.folder, plan, table);
  write_page(bench.folder, plan, table);
  const std::string html = read_text_file(bench.folder / "study.html");
  CHECK_THAT(html,
             Contains("numerical scatter") && Contains("<svg") && Contains("prefers-color-scheme"));
  // the policy lets a browser load nothing, and run no script but the one with that digest
  CHECK_THAT(html, Contains("\"default-src 'none'; script-src 'sha256-"));
  for (const char* outside : {"https://", "src='", "src=\"", "<link", "url(h", "@import"})
    CHECK_THAT(html, !Contains(outside));
  CHECK(read_text_file(bench.folder / "table.csv") == to_csv(table));
  CHECK_THAT(
      read_text_file(bench.folder / "columns.csv"),
      Contains("one,,input,stages.one.with.value") && Contains("sum,,found,sum (sample.sum)"));
  CHECK(std::filesystem::exists(bench.folder / "table.h5"));
  CHECK_THAT(read_text_file(bench.folder / "figures/sum-tornado.svg"),
             Contains("xmlns='http://www.w3.org/2000/svg'"));
}

TEST_CASE("The page answers in words, warns, and leads to the runs", "[study]") {
  StudyBench bench;
  const Plan plan = bench.plan(kStudy);
  bench.run(plan);
  Table table = make_table(plan, bench.progress(plan));
  table.warnings = {{"count", "beyond <1> & 2", 3, {0, 1, 2}}};
  const StudyFindings findings = analyse(plan, table);
  StudyAbout about;
  about.reports.resize(table.rows);
  about.reports[0] = "stages/report/a/report/report.html";
  const std::string html = make_page(plan, table, findings, about).html;
  // sum = factor * (one + 2) for one 1..4 and factor 1, 2: its largest is 12, its median 6.
  CHECK_THAT(html, Contains("Half of the rows have a sum above <b>6</b>") &&
                       Contains("Numerics alone move one row by") &&
                       Contains("<b>factor</b>: 4.5 on average at 1, 9 at 2: +4.5 ("));
  CHECK_THAT(html,
             Contains("count: beyond &lt;1&gt; &amp; 2 <span class='note'>Rows 1 to 3.</span>"));
  CHECK_THAT(html, Contains("href='stages/report/a/report/report.html#the-flow' target='left'"));
  CHECK_THAT(make_page(plan, table, findings).html, !Contains("<iframe"));
}

TEST_CASE("Stages' warnings that differ in numbers only are told once", "[study]") {
  StudyBench bench;
  Plan plan = bench.plan(kStudy);
  bench.run(plan);
  const Store store(bench.folder);
  const StudyState before = bench.progress(plan);
  std::size_t sums = 0;
  for (std::size_t n = 0; n < plan.nodes.size(); ++n) {
    if (plan.nodes[n].stage.name != "sum") continue;
    Finished f = *store.finished("sum", before.node(n).key);
    f.record.facts = fmt::format(R"({{"sum": 1, "warnings": ["{} m are too few"]}})", ++sums);
    store.write(f);
    // What the look at the settings says is not among the facts.
    plan.nodes[n].stage.warnings = {fmt::format("cell: {} m is coarse.", sums)};
  }
  const Table table = make_table(plan, bench.progress(plan));
  REQUIRE(table.warnings.size() == 2);
  for (const TableWarning& w : table.warnings) {
    CHECK(w.stage == "sum");
    CHECK(w.rows == table.rows);
  }
  CHECK_THAT(table.warnings[0].text, Contains(" m is coarse"));
  CHECK_THAT(table.warnings[1].text, Contains(" m are too few"));
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
  CHECK(without_unit("volume_past_toe_m3_per_m") == "volume_past_toe");
  CHECK(without_unit("particles") == "particles");
}

TEST_CASE("Facts in groups and of named things are columns too", "[study]") {
  StudyBench bench;
  const Plan plan = bench.plan("");
  bench.run(plan);
  const Store store(bench.folder);
  const StudyState before = bench.progress(plan);
  for (std::size_t n = 0; n < plan.nodes.size(); ++n) {
    if (plan.nodes[n].stage.name != "sum") continue;
    Finished f = *store.finished("sum", before.node(n).key);
    f.record.facts = R"({"crest": {"x_m": -20, "outward": {"both_m": 1.5, "flow_m": null}},
      "regions": [{"name": "lower dam", "failed_share": 0.25}, {"failed_share": 1}, 7],
      "warnings": ["one"], "name": "word"})";
    store.write(f);
  }
  const Table table = make_table(plan, bench.progress(plan));
  REQUIRE(table.find("crest.outward.both_m"));
  CHECK(table.find("crest.outward.both_m")->number == std::vector<double>{1.5});
  CHECK(table.find("crest.outward.both_m")->unit == "m");
  REQUIRE(table.find("regions.lower dam.failed_share"));
  CHECK(table.find("regions.lower dam.failed_share")->number == std::vector<double>{0.25});
  CHECK(table.find("name")->text == std::vector<std::string>{"word"});
  for (const char* none : {"crest.outward.flow_m", "regions.failed_share", "warnings", "sum"})
    CHECK_FALSE(table.find(none));
}

TEST_CASE("A column that is not there is refused by its name", "[study]") {
  StudyBench bench;
  const Plan plan = bench.plan("  analysis: {results: [runout]}\n");
  bench.run(plan);
  const Table table = make_table(plan, bench.progress(plan));
  CHECK_THROWS_WITH(analyse(plan, table), Contains("no column of numbers 'runout'"));
}

TEST_CASE("A page can have thresholds and no result", "[study]") {
  StudyBench bench;
  const Plan plan = bench.plan(
      "  vary: {one: {setting: stages.one.with.value, range: {from: 1, to: 9, step: 1}}}\n"
      "  analysis: {thresholds: [[one, sum]]}\n");
  bench.run(plan);
  const Table table = make_table(plan, bench.progress(plan));
  StudyFindings f = analyse(plan, table);
  f.results.clear();
  f.scatter.clear();
  f.exceedance.clear();
  CHECK_THAT(make_page(plan, table, f).html, Contains("<li>sum against one: "));
}

TEST_CASE("A fact that has the name of a variable is another column", "[study]") {
  StudyBench bench;
  const Plan plan = bench.plan("  vary: {sum: {setting: stages.one.with.value, values: [1, 2]}}\n");
  bench.run(plan);
  const Table table = make_table(plan, bench.progress(plan));
  CHECK(table.find("sum")->number == std::vector<double>{1.0, 2.0});
  REQUIRE(table.find("found:sum"));
  CHECK(table.find("found:sum")->number == std::vector<double>{3.0, 4.0});
  std::set<std::string> names;
  for (const Column& c : table.columns) CHECK(names.insert(c.name).second);
}

TEST_CASE("Variants are compared by the numbers of their inputs, or it is told why not",
          "[study]") {
  StudyBench bench;
  const auto findings = [&](const std::string& values) {
    const Plan plan = bench.plan(
        "  set: {stages.count.with.steps: 1}\n"
        "  vary: {one: {setting: stages.one.with.value, values: [1, 2, 3]}}\n"
        "  also:\n    half: {set: {stages.sum.with.factor: 0.5}, "
        "vary: {one: {setting: stages.one.with.value, values: [" +
        values + "]}}}\n  analysis: {results: [sum]}\n");
    bench.run(plan);
    const Table table = make_table(plan, bench.progress(plan));
    const Page page = make_page(plan, table, analyse(plan, table));
    CHECK((page.html.find("not compared: ") != std::string::npos) ==
          !analyse(plan, table).not_compared.empty());
    return analyse(plan, table);
  };
  const StudyFindings same = findings("1.0, 2.00");
  CHECK(same.not_compared.empty());
  REQUIRE(same.comparisons.size() == 3);
  CHECK(same.comparisons[0].ratio.value == Approx(2.0));
  const StudyFindings other = findings("5, 6");
  CHECK(other.comparisons.empty());
  REQUIRE(other.not_compared.size() == 1);
  CHECK(other.not_compared[0].variant == "half");
  CHECK_THAT(other.not_compared[0].why, Contains("no row of base has the values"));
}

TEST_CASE("Exceedance and tornado stand on what was observed, every repeat", "[study]") {
  StudyBench bench;
  // The factor acts behind `one` and `two`; the sum of each row is repeated, its inputs are not.
  const Plan plan = bench.plan(
      "  set: {stages.sum.with.factor: 1}\n"
      "  vary:\n"
      "    one: {setting: stages.one.with.value, values: [1, 2]}\n"
      "    steps: {setting: stages.count.with.steps, values: [1, 2, 3]}\n"
      "  repeat: {count: 2, scale: {stages.sum.with.factor: 1e-3}, rows: {one: [1]}}\n"
      "  analysis: {results: [sum]}\n");
  bench.run(plan);
  const Table table = make_table(plan, bench.progress(plan));
  const StudyFindings f = analyse(plan, table);
  // Three rows take each sum on: 3 and 3.003 (repeats of one row), and 4.
  CHECK(f.exceedance[0].value.size() == 3);
  CHECK(f.exceedance[0].weight == std::vector<double>{0.5, 0.5, 1.0});
  CHECK(f.exceedance[0].share[2] == Approx(1.0 / 3.0));
  // One observation at each end of `one`: their difference, whatever the rows that pass it on.
  const auto swing = std::find_if(f.swings.begin(), f.swings.end(),
                                  [](const Swing& s) { return s.input == "one"; });
  REQUIRE(swing != f.swings.end());
  CHECK(swing->effect.swing.rows == 2);
  CHECK(swing->effect.swing.value == Approx(4.0 - 3.0015));
}

TEST_CASE("What a stage has found counts once, with its repeats or without", "[study]") {
  StudyBench bench;
  // `sum` of each `one` serves three rows of `steps`; one of them is repeated, and that moves `sum`
  const Plan plan = bench.plan(
      "  set: {stages.sum.with.factor: 1}\n"
      "  vary:\n"
      "    one: {setting: stages.one.with.value, range: {from: 1, to: 6, step: 1}}\n"
      "    steps: {setting: stages.count.with.steps, values: [1, 2, 3]}\n"
      "  repeat: {count: 3, scale: {stages.one.with.value: 1e-6}, rows: {one: [2], steps: [2]}}\n"
      "  analysis: {results: [sum]}\n");
  bench.run(plan);
  const Table table = make_table(plan, bench.progress(plan));
  const StudyFindings f = analyse(plan, table);
  const auto relation = std::find_if(f.relations.begin(), f.relations.end(),
                                     [](const Relation& r) { return r.x == "one"; });
  REQUIRE(relation != f.relations.end());
  CHECK(relation->spearman.rows == 6);
  CHECK(relation->spearman.value == Approx(1.0));
  double weight = 0.0;
  for (const double w : f.exceedance[0].weight) weight += w;
  CHECK(weight == Approx(6.0));
  CHECK(f.exceedance[0].value.size() == 8);
}

TEST_CASE("Repeats that do not disturb what found a number are no repeats of it", "[study]") {
  StudyBench bench;
  const Plan plan = bench.plan(
      "  set: {stages.sum.with.factor: 1}\n"
      "  vary: {one: {setting: stages.one.with.value, values: [1, 2]}}\n"
      "  repeat: {count: 2, scale: {stages.sum.with.factor: 1e-3}}\n"
      "  analysis: {results: [sum, runout_m]}\n");
  bench.run(plan);
  const Table table = make_table(plan, bench.progress(plan));
  const StudyFindings f = analyse(plan, table);
  CHECK(f.scatter[0].repeated == 2);
  CHECK(f.scatter[1].repeated == 0);  // `one` and `two` found it, before anything was disturbed
  CHECK_FALSE(is_set(f.scatter[1].numerical));
}

TEST_CASE("Bars of equal length stand in the order of their names", "[study]") {
  Effect effect{.low_label = "l", .high_label = "h", .low = 1.0, .high = 2.0, .swing = {1.0}};
  const std::vector<Swing> one{{"b", "r", effect}, {"a", "r", effect}, {"c", "r", effect}};
  const std::vector<Swing> two{{"c", "r", effect}, {"b", "r", effect}, {"a", "r", effect}};
  CHECK(draw_tornado(one, kUnset, "r").alone("") == draw_tornado(two, kUnset, "r").alone(""));
}

TEST_CASE("The page removes its own figures only, and follows no link", "[study]") {
  StudyBench bench;
  const auto write = [&](const std::string& result) {
    const Plan plan = bench.plan(
        "  vary: {one: {setting: stages.one.with.value, values: [1, 2, 3]}}\n"
        "  analysis: {results: [" +
        result + "]}\n");
    bench.run(plan);
    write_page(bench.folder, plan, make_table(plan, bench.progress(plan)));
  };
  const auto is_there = [&](const std::string& name) {
    return std::filesystem::exists(bench.folder / "figures" / name);
  };
  write("sum");
  REQUIRE(is_there("sum-tornado.svg"));
  std::ofstream(bench.folder / "figures/mine.svg") << "<svg/>";
  std::ofstream(bench.folder / "figures/sum-exceedance.svg") << "<svg>improved</svg>";
  write("runout_m");
  CHECK(is_there("mine.svg"));
  CHECK(is_there("sum-exceedance.svg"));
  CHECK_FALSE(is_there("sum-tornado.svg"));

  bench.scratch.write("elsewhere/thesis.svg", "<svg/>");
  std::filesystem::remove_all(bench.folder / "figures");
  std::filesystem::create_directory_symlink(bench.scratch / "elsewhere", bench.folder / "figures");
  CHECK_THROWS_WITH(write("sum"), Contains("is a link"));
  CHECK(std::distance(std::filesystem::directory_iterator(bench.scratch / "elsewhere"), {}) == 1);
}

TEST_CASE("An analysis stops when it is told to", "[study]") {
  StudyBench bench;
  const Plan plan = bench.plan(kStudy);
  bench.run(plan);
  const std::atomic<bool> stop = true;
  CHECK_THROWS_AS(analyse(plan, make_table(plan, bench.progress(plan)), &stop), Interrupted);
}
