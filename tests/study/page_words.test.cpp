#include "core/files.hpp"
#include "study/page/consequences.hpp"
#include "study/page/labels.hpp"
#include "study/page/page_tables.hpp"
#include "study/page/setting_meaning.hpp"
#include "study/page/words.hpp"
#include "tests/study/study_bench.hpp"
#include "tests/support/paths.hpp"
#include "workflows/stages/stage_list.hpp"

using namespace flowslide;
using namespace flowslide::study;
using namespace flowslide::study::sample;
using Catch::Contains;

namespace {

/// Text of all sources of some modules.
std::string sources(std::initializer_list<const char*> modules) {
  std::string text;
  for (const char* module : modules)
    for (const auto& entry : std::filesystem::recursive_directory_iterator(test::source(module)))
      if (entry.path().extension() == ".cpp") text += read_file(entry.path(), 1u << 22);
  return text;
}

Column numbers(const std::string& name, Role role, std::vector<double> values) {
  Column c;
  c.name = name;
  c.role = role;
  c.is_number = true;
  c.number = std::move(values);
  for (const double v : c.number) c.text.push_back(is_set(v) ? fmt::format("{:g}", v) : "");
  return c;
}

}  // namespace

TEST_CASE("Every warning whose meaning is told is one that a stage can give", "[study]") {
  const std::string text = sources({"fem", "mpm", "report", "transfer", "workflows"});
  for (const Consequence& c : known_consequences()) {
    INFO(c.words);
    CHECK(text.find(c.words) != std::string::npos);
    CHECK(consequence_of("before " + std::string(c.words) + " after") == c.meaning);
  }
  CHECK(text.find("no stage says this of a dam") == std::string::npos);
  CHECK(consequence_of("no stage says this of a dam").empty());
}

TEST_CASE("Warnings tell in how many rows, in which, and what for", "[study]") {
  Table table;
  table.rows = 40;
  table.warnings = {{"flow", "The run was stopped before rest: <b>", 3, {1, 2, 7}},
                    {"map", "odd", 1, {39}}};
  const std::string html = warnings(table);
  CHECK_THAT(html,
             Contains("<b>In 3 of 40 rows</b>, flow: The run was stopped before rest: &lt;b"));
  CHECK_THAT(html, Contains("<span class='means'>The runout is a lower bound.</span> <span "
                            "class='note'>Rows 2 to 3, 8.</span>"));
  CHECK_THAT(html, Contains("<b>In 1 of 40 rows</b>, map: odd <span class='note'>Row 40.</span>"));
}

TEST_CASE("Of many rows the first dozen pieces are told", "[study]") {
  CHECK(spans_of({}).empty());
  CHECK(spans_of({0, 1, 2, 5}) == "1 to 3, 6");
  std::vector<std::size_t> odd;
  for (std::size_t k = 0; k < 20; ++k) odd.push_back(2 * k);
  CHECK_THAT(spans_of(odd), Contains("1, 3, ") && Contains(", 23 and 8 more"));
}

TEST_CASE("A setting that is varied is told with the words of its manual", "[study]") {
  Plan plan;
  const auto add = [&](const char* stage, const char* type) {
    Node& node = plan.nodes.emplace_back();
    node.stage.name = stage;
    node.stage.type.name = type;  // as of a plan that was read from its record
  };
  add("map", "transfer.map");
  add("mesh", "mesh.section");
  CHECK_THAT(setting_meaning(plan, "stages.map.with.c_soft_ratio"),
             Contains("c_soft / S_r, strength of liquefied soil after large strain"));
  CHECK_FALSE(setting_meaning(plan, "stages.map.with.audit.kinetic_energy").empty());
  CHECK(setting_meaning(plan, "stages.map.with.audit.kinetic_energy") !=
        setting_meaning(plan, "stages.map.with.audit"));
  CHECK(setting_meaning(plan, "stages.map.with.not_there").empty());
  CHECK(setting_meaning(plan, "stages.flow.with.cell").empty());
  CHECK(setting_meaning(plan, "stages.map").empty());
  CHECK(setting_meaning(plan, "").empty());
}

TEST_CASE("A depth between nodes is shown where all rows have one", "[study]") {
  Table table;
  table.rows = 2;
  table.columns = {numbers("liquefaction_depth_pond_m", Role::found, {2.5, 5.0}),
                   numbers("liquefaction_depth_pond_interpolated_m", Role::found, {2.7, 5.1}),
                   numbers("liquefaction_depth_crest_m", Role::found, {2.5, 5.0}),
                   numbers("liquefaction_depth_crest_interpolated_m", Role::found, {kUnset, 5.0}),
                   numbers("liquefaction_depth_toe_m", Role::found, {2.5, 5.0})};
  CHECK(finer(table, "liquefaction_depth_pond_m") == "liquefaction_depth_pond_interpolated_m");
  CHECK(finer(table, "liquefaction_depth_crest_m") == "liquefaction_depth_crest_m");
  CHECK(finer(table, "liquefaction_depth_toe_m") == "liquefaction_depth_toe_m");
  CHECK(finer(table, "pga") == "pga");
}

TEST_CASE("The table of rows leaves out what is the same in all, and says which row a link opens",
          "[study]") {
  StudyBench bench;
  const Plan plan = bench.plan(kValues + "  analysis: {results: [sum]}\n");
  bench.run(plan);
  Table table = make_table(plan, bench.progress(plan));
  const StudyFindings findings = analyse(plan, table);
  StudyAbout about;
  about.reports.resize(table.rows);
  about.reports[2] = "run.html";
  const std::string html = rows_table(plan, table, findings, about);
  CHECK_THAT(html, Contains("<th>row</th><th class='word'>run</th><th>one</th>"));
  CHECK_THAT(html, !Contains(">cause<") && !Contains(">state<"));
  CHECK_THAT(html, Contains("data-row='2' title='row 3: " + plan.rows[2].label() + "'"));
  for (Column& c : table.columns)
    if (c.name == "state") c.text[0] = "failed";
  CHECK_THAT(rows_table(plan, table, findings, about), Contains("'word failed'>failed<"));
}

TEST_CASE("Relations are told the strongest first, and all of them folded", "[study]") {
  Table table;
  table.rows = 3;
  table.columns = {numbers("weak", Role::input, {1, 2, 3}),
                   numbers("strong", Role::input, {1, 2, 3}),
                   numbers("none", Role::input, {1, 2, 3}), numbers("y", Role::found, {1, 2, 3})};
  StudyFindings f;
  f.results = {"y"};
  const auto relate = [&](const char* x, Estimate e) {
    Relation& r = f.relations.emplace_back();
    r.x = x;
    r.y = "y";
    r.spearman = e;
  };
  Estimate weak, strong, none;
  weak.value = 0.3, weak.low = 0.1, weak.high = 0.5;
  strong.value = -0.9, strong.low = -0.95, strong.high = -0.8;
  none.value = 0.1, none.low = -0.3, none.high = 0.4;
  relate("weak", weak);
  relate("none", none);
  relate("strong", strong);
  const std::string html = relations_list(table, f);
  CHECK_THAT(html, Contains("<ol><li><b>strong</b>: smaller with it") &&
                       Contains("<b>weak</b>: larger with it") &&
                       Contains("<b>none</b>: no tendency that these rows show"));
  CHECK(html.find("<b>weak") < html.find("<b>none"));
  CHECK_THAT(html, Contains("<details><summary>y against all 3 of them</summary>"));
}
