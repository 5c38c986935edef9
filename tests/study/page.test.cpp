#include "report/page.hpp"

#include "report/page_arrays.hpp"
#include "study/page/explorer_data.hpp"
#include "tests/study/study_bench.hpp"

#include <cstdlib>
#include <fstream>
#include <random>

#include <nlohmann/json.hpp>

using namespace flowslide;
using namespace flowslide::study;
using namespace flowslide::study::sample;
using Catch::Contains;
using namespace std::string_literals;

namespace {

/// sum = factor * (one + 2), not known in the first three rows, its factor disturbed by a
/// thousandth.
const std::string kExplored =
    "  set: {stages.count.with.steps: 1, stages.sum.with.factor: 1}\n"
    "  vary:\n"
    "    one: {setting: stages.one.with.value, values: [1, 2, 3, 4], labels: [a, b, \"</script>\", "
    "d]}\n"
    "    factor: {setting: stages.sum.with.factor, values: [1, 2]}\n"
    "  repeat: {count: 3, scale: {stages.sum.with.factor: 1e-3}}\n"
    "  analysis: {results: [sum]}\n";

struct Explored {
  StudyBench bench;
  Plan plan;
  Table table;
  StudyAbout about;

  Explored() : plan(bench.plan(kExplored)) {
    bench.run(plan);
    table = make_table(plan, bench.progress(plan));
    for (std::size_t k = 0; k < table.columns.size(); ++k)
      if (Column& c = table.columns[k]; c.name == "sum")
        for (std::size_t row = 0; row < 3; ++row) {
          c.number[row] = kUnset;
          c.text[row] = "";
        }
    about.reports.resize(table.rows);
  }
  [[nodiscard]] std::string page() const {
    return make_page(plan, table, analyse(plan, table), about).html;
  }
  /// As if the last stage were a report, whose page has a player of points that wander.
  void with_players(std::size_t states, std::size_t points) {
    for (Node& node : plan.nodes)
      if (node.stage.name == "count") node.stage.type.name = "report.runout";
    const Column* key = table.find("key:count");
    REQUIRE(key);
    std::minstd_rand random(1);
    std::uniform_real_distribution<double> move(0.0, 1.0);
    for (std::size_t row = 0; row < table.rows; ++row) {
      PageArrays arrays;
      std::vector<double> x(states * points);
      for (std::size_t k = points; k < x.size(); ++k) x[k] = x[k - points] + move(random);
      arrays.add("points.x", x, states);
      bench.scratch.write(
          fmt::format("{}/stages/count/{}/report/report.html", bench.folder.filename().string(),
                      key->text[row]),
          fmt::format("<style>p{{}}</style>{}{{\"points\":{{\"frames\":{}}},\"arrays\":{}}}"
                      "</script>{}{}</script><script>run()</script>\n",
                      kPageRun, states, arrays.index(), kPageArrays, arrays.text()));
    }
  }
};

const nlohmann::json& column(const nlohmann::json& data, const std::string& name) {
  for (const auto& c : data["columns"])
    if (c["name"] == name) return c;
  FAIL("there is no column " + name);
  return data;
}

}  // namespace

TEST_CASE("The chart of a page has the table's numbers, and which rows are repeats", "[study]") {
  Explored e;
  e.about.reports[4] = "run.html";
  const auto data = nlohmann::json::parse(
      explorer_json(e.plan, e.table, analyse(e.plan, e.table), e.about, {"factor", "sum", "one"}));
  CHECK(data["labels"].size() == 24);
  CHECK(data["labels"][4] == "row 5: one a, factor 2, repeat 1");
  CHECK(data["pages"][4] == "run.html");
  CHECK(data["pages"][5] == "");
  // three repeats of each of eight rows
  CHECK(data["groups"][0] == data["groups"][2]);
  CHECK(data["groups"][2] != data["groups"][3]);
  const auto& sum = column(data, "sum");
  CHECK(sum["group"] == "Results");
  CHECK(sum["values"][0].is_null());
  CHECK(sum["values"][3] == 6.0);
  CHECK(sum["values"][4].get<double>() == Approx(6.006));
  const auto& one = column(data, "one");
  CHECK(one["group"] == "Inputs");
  CHECK(one["words"] == nlohmann::json{"a", "b", "</script>", "d"});
  CHECK(one["values"][6] == 1);
  CHECK(data["start"]["colour"] == "one");
}

TEST_CASE("Rows whose page cannot be read are told", "[study]") {
  Explored e;
  CHECK_THAT(e.page(), !Contains("are damaged"));
  e.about.stories = Stories{};
  e.about.stories->json = "{}";
  CHECK_THAT(e.page(), !Contains("are damaged"));
  e.about.stories->damaged = {3, 4, 7};
  CHECK_THAT(e.page(), Contains("are not shown: 4 to 5, 8. Make their reports again."));
}

TEST_CASE("A label of a user ends no script of the page", "[study]") {
  const std::string html = Explored().page();
  const std::size_t data = html.find("id='study'>");
  REQUIRE(data != std::string::npos);
  const std::string rest = html.substr(data);
  CHECK_THAT(rest.substr(0, rest.find("</script>")), Contains("\\u003c/script>"));
}

TEST_CASE("Pages of runs are put into the page once, and what they share once", "[study]") {
  Explored e;
  const auto page_of = [](const std::string& words) {
    return "<style>p{}</style><p>" + words +
           "</p><script type=\"text/plain\" id=\"arrays\">QUJD</script><script>run()</script>\n";
  };
  e.bench.scratch.write("a.html", page_of("one"));
  e.bench.scratch.write("b.html", page_of("two"));
  e.bench.scratch.write("c.html", "<p>of an earlier program</p>");
  std::vector<std::string> reports{"a.html", "", "b.html", "a.html", "c.html"};
  const std::atomic<bool> stop = true;
  auto untouched = reports;
  CHECK_THROWS_AS(embed_runs(e.bench.scratch / "", untouched, 0, &stop), Interrupted);
  const EmbeddedRuns runs = embed_runs(e.bench.scratch / "", reports);
  CHECK(reports == std::vector<std::string>{"run-1", "", "run-2", "run-1", "run-3"});
  CHECK(runs.scripts == std::vector{policy_hash("run()")});
  CHECK(runs.styles == std::vector{policy_hash("p{}")});
  CHECK_THAT(
      runs.elements,
      Contains(
          "id='run-1' data-style='part-1' data-script='part-2'>" +
          packed(
              "<style>\0</style><p>one</p><script type=\"text/plain\" id=\"arrays\">\0</script><script>\0</script>\n"s) +
          ".QUJD</script>"));
  CHECK_THAT(runs.elements,
             Contains("id='run-3'>" + packed("<p>of an earlier program</p>") + ".</script>"));
  e.about.reports.assign(e.table.rows, "run-1");
  e.about.embedded = runs;
  const std::string html = e.page();
  CHECK_THAT(html, Contains(" " + policy_hash("run()") + "; style-src ") &&
                       Contains("They are in this file.") && Contains(runs.elements));
  CHECK_THAT(html, !Contains("run-1#the-flow"));
}

TEST_CASE("A whole page says of which rows it has no run", "[study]") {
  Explored e;
  const WholePage whole = write_whole_page(e.bench.folder, e.plan, e.table);
  // the sample's stages write no pages
  CHECK(whole.rows == 0);
  CHECK(whole.no_report.size() == 24);
  CHECK(whole.not_kept.empty());
  CHECK(whole.not_done.empty());
  CHECK(whole.bytes == std::filesystem::file_size(whole.path));
  // as if the last stage were a report whose page has gone, and not done in the first row
  for (Node& node : e.plan.nodes)
    if (node.stage.name == "count") node.stage.type.name = "report.runout";
  for (Column& c : e.table.columns)
    if (c.name == "state") c.text[0] = "open";
  const WholePage gone = write_whole_page(e.bench.folder, e.plan, e.table);
  CHECK(gone.not_done == std::vector<std::size_t>{1});
  CHECK(gone.not_kept.size() == 23);
  CHECK(gone.no_report.empty());
}

TEST_CASE("A whole page has as many states as its size allows", "[study]") {
  Explored e;
  e.with_players(40, 300);
  const auto written = [&](const WholeSize& size) {
    return write_whole_page(e.bench.folder, e.plan, e.table, size);
  };
  const WholePage all = written({.states = 40, .bytes = 1.0});
  CHECK(all.rows == 24);
  CHECK(all.states == 40);
  CHECK(written({}).bytes == all.bytes);  // below 60 MB there is no need
  const double size = 0.8 * static_cast<double>(all.bytes);
  const WholePage fitted = written({.bytes = size});
  CHECK(static_cast<double>(fitted.bytes) <= size);
  CHECK(fitted.states < 40);
  CHECK(fitted.states > 20);  // a fifth of the bytes is no reason to leave out half of the states
  CHECK(fitted.all_states == 40);
  CHECK(std::filesystem::file_size(fitted.path) == fitted.bytes);
  CHECK(written({.bytes = 1.0}).states == 12);
}

TEST_CASE("Child of the browser test: writes the page of a study", "[.page-child]") {
  const char* out = std::getenv("FLOWSLIDE_PAGE");
  REQUIRE(out);
  Explored e;
  for (std::size_t row = 0; row < e.table.rows; ++row)
    e.about.reports[row] = row < 6 ? "" : row % 2 ? "long.html" : "short.html";
  e.about.stories =
      read_stories(std::filesystem::path(out).parent_path(), e.table, e.about.reports);
  if (std::getenv("FLOWSLIDE_WHOLE"))
    e.about.embedded = embed_runs(std::filesystem::path(out).parent_path(), e.about.reports);
  std::ofstream(out) << e.page();
}
