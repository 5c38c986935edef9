#include "tests/cli/program.hpp"

#include <sstream>

#include <nlohmann/json.hpp>

using namespace flowslide;
using namespace flowslide::cli::test;
using Catch::Contains;

namespace {

/// Imports of one element with two rules, and more if asked for.
void write_study(const Scratch& scratch, const std::string& more_values = "",
                 const std::string& more_labels = "") {
  write_model(scratch);
  scratch.write("w.yaml", "schema: 1\nname: w\nstages:\n" + shake());
  scratch.write("s.yaml",
                "schema: 1\nname: s\nstudy:\n  workflow: w.yaml\n  vary:\n    rule:\n"
                "      setting: stages.shake.with.sigma_zz\n"
                "      values: [{rule: mean}, {rule: elastic, nu: 0.3}" +
                    more_values + "]\n      labels: [mean, elastic" + more_labels + "]\n");
}

void write_copy(const Scratch& scratch, const std::string& from, const std::string& to) {
  std::filesystem::copy_file(scratch / from, scratch / to);
}

std::string line_with(const std::string& text, const std::string& word) {
  const std::size_t at = text.find("\"" + word + "\""), begin = text.rfind('\n', at) + 1;
  return text.substr(begin, text.find('\n', at) - begin);
}

std::size_t lines_of(const std::string& text) {
  return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

}  // namespace

TEST_CASE("a study runs, is then done, and tells of itself", "[cli]") {
  const Scratch scratch;
  write_study(scratch);
  CHECK_THAT(call(scratch, "study run s.yaml --dry-run").out,
             Contains("shake    2 to run of 2, ") && Contains("all      2 to run of 2, "));
  // One after the other they last as long as they take, side by side as long as one of them.
  const auto expected = [&](const char* jobs) {
    return nlohmann::json::parse(line_with(
        call(scratch, std::string("study run s.yaml --dry-run --json --jobs ") + jobs).out,
        "plan"));
  };
  const auto one = expected("1"), two = expected("2");
  CHECK(one["processor_seconds"] > 0.0);
  CHECK(one["seconds"].get<double>() == Approx(one["processor_seconds"].get<double>()));
  CHECK(two["seconds"].get<double>() == Approx(0.5 * one["seconds"].get<double>()));
  CHECK_FALSE(std::filesystem::exists(scratch / "runs"));
  Outcome o = call(scratch, "study run s.yaml --jobs 2");
  INFO(o.err);
  REQUIRE(o.code == 0);
  CHECK_THAT(o.out, Contains("2 done, 0 failed") && Contains("2/2 shake"));
  const std::string table = read_text_file(scratch / "runs/s/table.csv");
  CHECK(lines_of(table) == 3);
  CHECK_THAT(table, Contains("base,mean,0,done") && Contains("base,elastic,0,done"));
  CHECK(std::filesystem::exists(scratch / "runs/s/study.html"));
  CHECK_THAT(o.err, Contains("warning: shake: gravity: the total vertical") && Contains("(2 rows"));
  o = call(scratch, "study run s.yaml");
  CHECK(o.code == 0);
  CHECK_THAT(o.out, Contains("2 stages, 2 of them done") && !Contains("/2 shake"));
  CHECK(read_text_file(scratch / "runs/s/table.csv") == table);
  CHECK(call(scratch, "study table runs/s").out == table);
  CHECK_THAT(call(scratch, "study status runs/s").out, Contains("2 rows done, 0 failed, 0 open"));
  CHECK(call(scratch, "study report runs/s").code == 0);
  CHECK_FALSE(std::filesystem::exists(scratch / "runs/s/study-whole.html"));
  o = call(scratch, "study report runs/s --whole --frames 10");
  CHECK(o.code == 0);
  CHECK_THAT(o.out, Contains("study-whole.html (0.") && Contains("the runs of 0 of 2 rows"));
  CHECK_THAT(o.err, Contains("2 of 2 rows have no run in it because their workflow has no stage"));
  CHECK(std::filesystem::exists(scratch / "runs/s/study-whole.html"));
  CHECK(call(scratch, "study report runs/s --frames 10").code == 2);
  CHECK_THAT(call(scratch, "study clean runs/s").out, Contains("0 results"));
  CHECK(call(scratch, "study run s.yaml --quiet").out.empty());
}

TEST_CASE("a study keeps what it cost, and where it ran", "[cli]") {
  const Scratch scratch;
  write_study(scratch);
  REQUIRE(call(scratch, "study run s.yaml --jobs 2 --threads 2").code == 0);
  const auto sessions = [&] {
    std::vector<std::string> texts;
    for (const auto& entry : std::filesystem::directory_iterator(scratch / "runs/s/sessions"))
      texts.push_back(read_text_file(entry.path()));
    return texts;
  };
  REQUIRE(sessions().size() == 1);
  const auto session = nlohmann::json::parse(sessions()[0]);
  CHECK(session["stages"] == 2);
  CHECK(session["jobs"] == 2);
  const double wall = session["wall_seconds"], used = session["processor_seconds"];
  CHECK(wall > 0.0);
  // Starting a process takes milliseconds; two of them and their parent use three processors.
  CHECK(used > 1e-3);
  CHECK(used < 3.0 * wall + 0.1);
  CHECK_THAT(session["began"].get<std::string>(), Catch::Matches("20..-..-..T..:..:..Z"));
  CHECK_THAT(read_text_file(scratch / "runs/s/study.html"),
             Contains(session["began"].get<std::string>()));
  // What computes nothing costs nothing.
  REQUIRE(call(scratch, "study run s.yaml").code == 0);
  CHECK(sessions().size() == 1);
}

TEST_CASE("a study tells programs as JSON", "[cli]") {
  const Scratch scratch;
  write_study(scratch);
  const Outcome o = call(scratch, "study run s.yaml --json");
  REQUIRE(o.code == 0);
  std::istringstream in(o.out);
  std::vector<std::string> events;
  for (std::string line; std::getline(in, line);)
    events.push_back(nlohmann::json::parse(line)["event"]);
  CHECK(events == std::vector<std::string>{"begin", "done", "done", "end"});
  const auto status = nlohmann::json::parse(call(scratch, "study status runs/s --json").out);
  CHECK(status["done"] == 2);
  CHECK(status["slurm"].is_null());
  CHECK(status["rows"][1]["set"][0] == "stages.shake.with.sigma_zz={rule: elastic, nu: 0.3}");
}

TEST_CASE("rows that fail are listed and give exit code 1", "[cli]") {
  const Scratch scratch;
  write_study(scratch, ", {rule: elastic, nu: 0.9}", ", wrong");
  Outcome o = call(scratch, "study run s.yaml");
  CHECK(o.code == 1);
  CHECK_THAT(o.err, Contains("s.yaml:6:") && Contains("nu"));
  CHECK_THAT(o.out, Contains("2 done, 1 failed") && Contains("failed: row 3 (rule wrong)"));
  CHECK_THAT(call(scratch, "study status runs/s").out, Contains("failed: row 3 (rule wrong)"));
  // Without it, the rest is there already.
  write_study(scratch);
  o = call(scratch, "study run s.yaml");
  CHECK(o.code == 0);
  CHECK_THAT(o.out, Contains("2 of them done"));
}

TEST_CASE("wrong studies end with the exit codes of the contract", "[cli]") {
  const Scratch scratch;
  write_study(scratch);
  CHECK(call(scratch, "study").code == 2);
  CHECK(call(scratch, "study rum s.yaml").code == 2);
  CHECK(call(scratch, "study run none.yaml").code == 4);
  CHECK(call(scratch, "study run w.yaml").code == 2);
  CHECK(call(scratch, "study status .").code == 2);
  CHECK(call(scratch, "study stage nonsense").code == 2);
  // A folder of a single run is not taken for a study's.
  REQUIRE(call(scratch, "run w.yaml --out single").code == 0);
  const Outcome o = call(scratch, "study run s.yaml --out single");
  CHECK(o.code == 2);
  CHECK_THAT(o.err, Contains("holds a single run"));
  // The folder of another study is told, and is none of a run.
  REQUIRE(call(scratch, "study run s.yaml --out both").code == 0);
  write_copy(scratch, "s.yaml", "other.yaml");
  const Outcome other = call(scratch, "study run other.yaml --out both");
  CHECK(other.code == 0);
  CHECK_THAT(other.err, Contains("warning:") && Contains("holds the study of"));
  CHECK(call(scratch, "run w.yaml --out both").code == 2);
  CHECK_THAT(call(scratch, "study run other.yaml --out both").err, !Contains("holds the study"));
  scratch.write("bad.yaml", "schema: 1\nname: bad\nstudy:\n  workflow: w.yaml\n  vary: {a: {}}\n");
  CHECK_THAT(call(scratch, "study run bad.yaml").err, Contains("error: bad.yaml:5:"));
}

TEST_CASE("on a terminal a study draws its running stages and a total", "[cli]") {
  const Scratch scratch;
  write_study(scratch);
  const std::string text = on_terminal(scratch, "study run s.yaml", 60);
  CHECK_THAT(text, Contains("ETA") && Contains("2 done, 0 failed"));
}

TEST_CASE("the help of studies fits 80 columns", "[cli]") {
  const Scratch scratch;
  for (const char* command : {"", "run ", "status ", "table ", "report ", "clean ", "part "}) {
    const Outcome o = call(scratch, std::string("study ") + command + "--help");
    REQUIRE(o.code == 0);
    std::istringstream in(o.out);
    for (std::string line; std::getline(in, line);) {
      CAPTURE(line);
      CHECK(line.size() <= 80);
    }
  }
}

TEST_CASE("a stage whose workflow was edited says so and leaves nothing behind", "[cli]") {
  const Scratch scratch;
  write_study(scratch);
  REQUIRE(call(scratch, "study run s.yaml").code == 0);
  const auto status = nlohmann::json::parse(call(scratch, "study status runs/s --json").out);
  const std::string set = status["rows"][0]["set"][0];
  const nlohmann::json job = {{"store", (scratch / "runs/s").string()},
                              {"workflow", (scratch / "w.yaml").string()},
                              {"set", {set}},
                              {"stage", "shake"},
                              {"key", std::string(64, '0')},
                              {"threads", 1},
                              {"final_state", true},
                              {"allow", nlohmann::json::array()}};
  scratch.write("job.json", job.dump());
  const Outcome o = call(scratch, "study stage \"$(cat job.json)\"");
  CHECK(o.code == 0);
  CHECK(o.out == "changed\n");
}

TEST_CASE("what a study would run fits the terminal", "[cli]") {
  const Scratch scratch;
  write_study(scratch, ", {rule: k0, k0: 0.5}",
              ", a rule with a label of more words than a line has");
  for (const std::size_t columns : {60U, 80U}) {
    CAPTURE(columns);
    std::istringstream lines(on_terminal(scratch, "study run s.yaml --dry-run --jobs 2", columns));
    std::size_t longest = 0;
    for (std::string line; std::getline(lines, line);)
      longest = std::max(longest, line.substr(0, line.find('\r')).size());
    CHECK(longest <= columns);
    CHECK(longest > columns / 2);
  }
}

TEST_CASE("a row that cannot run did not fail before, and what is not there is no study", "[cli]") {
  const Scratch scratch;
  write_study(scratch, ", {rule: none}", ", none");
  const Outcome o = call(scratch, "study run s.yaml --dry-run");
  CHECK(o.code == 0);
  CHECK_THAT(o.err, Contains("cannot run: row 3 (rule none)") && !Contains("failed before"));
  for (const char* command : {"study status gone", "report gone"})
    CHECK_THAT(call(scratch, command).err, Contains("gone") && Contains("there is no such folder"));
}

TEST_CASE("a result that no stage gives is refused before anything runs", "[cli]") {
  const Scratch scratch;
  write_study(scratch);
  const std::string study = read_text_file(scratch / "s.yaml");
  const auto dry = [&](const std::string& analysis) {
    scratch.write("s.yaml", study + "  analysis: {" + analysis + "}\n");
    return call(scratch, "study run s.yaml --dry-run");
  };
  CHECK(dry("results: [fem_frames]").code == 0);  // control
  const Outcome o = dry("results: [fem_frames, fem_frame]");
  CHECK(o.code == 2);
  CHECK_THAT(o.err, Contains("s.yaml:10:36: analysis.results: no stage of the study gives a number "
                             "'fem_frame'") &&
                        Contains("Did you mean 'fem_frames'?"));
  CHECK_THAT(dry("results: runout_m").err, Contains("They give"));
  CHECK_THAT(dry("results: [rule]").err, Contains("is an input of the study and no result"));
  CHECK_THAT(dry("thresholds: [[fem_nodes, fem_element]]").err,
             Contains("analysis.thresholds") && Contains("'fem_elements'?"));
  CHECK_FALSE(std::filesystem::exists(scratch / "runs"));
}
