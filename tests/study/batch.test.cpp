#include "study/batch/slurm.hpp"
#include "study/batch/submit.hpp"
#include "tests/study/study_bench.hpp"
#include "tests/support/paths.hpp"

#include <chrono>
#include <numeric>
#include <set>
#include <thread>

using namespace flowslide;
using namespace flowslide::study;
using namespace flowslide::study::sample;
using Catch::Contains;

namespace {

/// 3 shared numbers and one for all, then 2 sums with a count each for every number.
struct Packed {
  StudyBench bench;
  Plan plan = bench.plan(kValues);
  std::vector<bool> open = std::vector<bool>(plan.nodes.size(), true);
  std::vector<double> seconds = std::vector<double>(plan.nodes.size(), 10.0);

  [[nodiscard]] std::vector<JobArray> arrays(const Packing& packing) const {
    return pack(plan, open, seconds, packing);
  }
  void set_seconds(const std::string& stage, double value) {
    for (std::size_t n = 0; n < plan.nodes.size(); ++n)
      if (plan.nodes[n].stage.name == stage) seconds[n] = value;
  }
};

/// "shared: two; rows: one sum sum count count | ..."
std::string words(const Plan& plan, const std::vector<JobArray>& arrays) {
  std::string text;
  for (const JobArray& array : arrays) {
    text += (text.empty() ? "" : "; ") + array.name + ":";
    for (const ArrayTask& task : array.tasks) {
      if (&task != &array.tasks.front()) text += " |";
      for (const std::size_t n : task.nodes) text += " " + plan.nodes[n].stage.name;
    }
  }
  return text;
}

/// Each open stage once, and everything that feeds it in the same task or in an array before.
void check_order(const Packed& packed, const std::vector<JobArray>& arrays) {
  std::set<std::size_t> before;
  for (const JobArray& array : arrays) {
    std::set<std::size_t> here;
    for (const ArrayTask& task : array.tasks) {
      std::set<std::size_t> mine;
      for (const std::size_t n : task.nodes) {
        for (const std::size_t from : packed.plan.nodes[n].before)
          CHECK((!packed.open[from] || before.contains(from) || mine.contains(from)));
        mine.insert(n);
        CHECK(here.insert(n).second);
      }
    }
    for (const std::size_t n : here) CHECK(before.insert(n).second);
  }
  CHECK(before.size() ==
        static_cast<std::size_t>(std::count(packed.open.begin(), packed.open.end(), true)));
}

/// A scheduler without machines: it takes every script.
struct Paper {
  std::vector<std::string> sent;
  Scheduler scheduler;

  Paper() {
    scheduler.name = "paper";
    scheduler.ending = ".txt";
    scheduler.text = [](const Script& script) { return script.about + "\n"; };
    scheduler.send = [this](const Script& script, const std::vector<std::string>& after) {
      sent.push_back(script.name + " after " + (after.empty() ? "nothing" : after.back()));
      return std::to_string(sent.size());
    };
  }
};

BatchOptions options_of(const StudyBench& bench, double chunk) {
  return {.packing = {.chunk = chunk},
          .memory = 1e9,
          .time = 600.0,
          .allowed_programs = {},
          .program = "/usr/bin/flowslide",
          .directory = bench.scratch.path()};
}

}  // namespace

TEST_CASE("Little work is one task, depth first", "[study]") {
  const Packed packed;
  const auto arrays = packed.arrays({.chunk = 80.0});
  REQUIRE(arrays.size() == 1);
  REQUIRE(arrays[0].tasks.size() == 1);
  CHECK(arrays[0].tasks[0].nodes.size() == 16);
  CHECK(arrays[0].tasks[0].seconds == 160.0);
}

TEST_CASE("Known costs give known arrays", "[study]") {
  Packed packed;
  // What all share waits for nobody; each number with its rows is 50 s, a chunk and more.
  auto arrays = packed.arrays({.chunk = 50.0});
  CHECK(words(packed.plan, arrays) ==
        "shared: two; rows: one sum count sum count | one sum count sum count | one sum count sum "
        "count");
  CHECK(arrays[1].tasks[0].seconds == 50.0);
  check_order(packed, arrays);
  // Two families of 50 s make a chunk of 75 s, and the third is too little for a task of its own.
  arrays = packed.arrays({.chunk = 75.0});
  CHECK(arrays.back().tasks.size() == 1);
  check_order(packed, arrays);
  // A family that is too long for a task is cut where its rows part.
  packed.set_seconds("one", 100.0);
  arrays = packed.arrays({.chunk = 50.0});
  CHECK(
      words(packed.plan, arrays) ==
      "shared: one two | one | one; rows: sum count sum count sum count | sum count sum count sum "
      "count");
  REQUIRE(arrays.size() == 2);
  CHECK(arrays[1].tasks[1].seconds == 60.0);
  check_order(packed, arrays);
}

TEST_CASE("A task is as long as its work on all its processors, or as its longest chain",
          "[study]") {
  Packed packed;
  packed.set_seconds("count", 100.0);
  const auto arrays = packed.arrays({.chunk = 1e6, .cpus = 4});
  REQUIRE(arrays.size() == 1);
  CHECK(arrays[0].tasks[0].seconds == (10.0 * 10.0 + 6.0 * 100.0) / 4.0);
  const auto wide = packed.arrays({.chunk = 1e6, .cpus = 100});
  CHECK(wide[0].tasks[0].seconds == 120.0);
}

TEST_CASE("Every task has a chunk of work at least, and an array a bounded number", "[study]") {
  Packed packed;
  for (std::size_t n = 0; n < packed.seconds.size(); ++n)
    packed.seconds[n] = 3.0 + static_cast<double>(n * 7 % 11);
  for (double chunk = 1.0; chunk < 200.0; chunk *= 1.3)
    for (const std::size_t most : {1000u, 2u}) {
      const auto arrays = packed.arrays({.chunk = chunk, .most_tasks = most});
      check_order(packed, arrays);
      for (const JobArray& array : arrays) {
        CHECK(array.tasks.size() <= most);
        const double sum =
            std::accumulate(array.tasks.begin(), array.tasks.end(), 0.0,
                            [](double s, const ArrayTask& task) { return s + task.seconds; });
        for (const ArrayTask& task : array.tasks)
          CHECK(task.seconds >= 0.999 * std::min(chunk, sum));
      }
    }
}

TEST_CASE("Only what is open is packed, and nothing needs nothing", "[study]") {
  Packed packed;
  packed.open.assign(packed.open.size(), false);
  CHECK(packed.arrays({}).empty());
  const Row& row = packed.plan.rows[3];
  packed.open[row.nodes[3]] = true;
  packed.seconds[row.nodes[3]] = kUnset;
  const auto arrays = packed.arrays({});
  CHECK(words(packed.plan, arrays) == "rows: count");
  CHECK(arrays[0].tasks[0].seconds == 60.0);
}

TEST_CASE("The script of an array is the one that is kept", "[study]") {
  SlurmSettings settings;
  settings.partition = "compute";
  settings.account = "geo";
  settings.options = {"--qos=low", "--comment=for \"Anna\" # 2"};
  Script script{.name = "rows",
                .study = "dam",
                .about = "Study dam, rows: 12 stages, expected to be 3 tasks of 33 to 38 min each.",
                .folder = "/data/dam/slurm/1",
                .directory = "/home/anna/it's here",
                .command = {"/usr/bin/flowslide", "study", "part", "/data/dam/slurm/1/rows.json"}};
  script.tasks = 3;
  script.cpus = 4;
  script.memory = 1.2e9;
  script.seconds = 2.0 * 3600.0;
  const Scheduler scheduler = slurm(settings, nullptr);
  CHECK(scheduler.text(script) == read_text_file(test::source("tests/study/slurm/rows.sbatch")));
  script.folder = "/data/50 %";
  CHECK_THROWS_WITH(scheduler.text(script), Contains("Choose another --out"));
  Script report = script;
  report.name = "report";
  CHECK(scheduler.commands({script, report}, {"17", "18"}) ==
        "cd '/data/50 %'\nrows=$(sbatch --parsable --dependency=afterany:17:18 rows.sbatch)\n"
        "sbatch --dependency=afterany:$rows report.sbatch\n");
}

TEST_CASE("Words are quoted for those who read them", "[study]") {
  CHECK(shell_word("/data/a-b_1.yaml") == "/data/a-b_1.yaml");
  CHECK(shell_word("") == "''");
  CHECK(shell_word("it's $HOME") == R"('it'\''s $HOME')");
  CHECK(shell_word("a\nb") == "'a\nb'");
  CHECK(sbatch_word("--qos=low") == "--qos=low");
  CHECK(sbatch_word(R"(--comment=a "b" \ #)") == R"("--comment=a \"b\" \\ #")");
  // The shell itself says what it makes of a word.
  for (const char* text :
       {"it's", "a b", "$(touch x)", "`x`", "\"", "\\", "*", "~", "a;b", "!", ""}) {
    const Scratch scratch;
    const std::string out = (scratch / "out").string();
    REQUIRE(std::system(("printf %s " + shell_word(text) + " >" + shell_word(out)).c_str()) == 0);
    CHECK(read_text_file(out) == text);
  }
}

TEST_CASE("Times are written as Slurm reads them", "[study]") {
  CHECK(slurm_time(1.0) == "00:01:00");
  CHECK(slurm_time(3600.0) == "01:00:00");
  CHECK(slurm_time(3601.0) == "01:01:00");
  CHECK(slurm_time(36.5 * 3600.0) == "1-12:30:00");
}

TEST_CASE("A queue is read, whatever is in it", "[study]") {
  const auto tasks = queued_tasks(
      "17|2|R|/data/a b|c/slurm/1/rows.sbatch\n18|N/A|PD|/data/report.sbatch\n19|0|CG|x\n\n|\n");
  REQUIRE(tasks.size() == 5);
  CHECK(tasks[0].job == "17");
  CHECK(tasks[0].task == 2);
  CHECK(tasks[0].running);
  CHECK(tasks[0].script == "/data/a b|c/slurm/1/rows.sbatch");
  CHECK_FALSE(tasks[1].running);
  CHECK(tasks[1].task == 0);
  CHECK(tasks[2].ending);
  CHECK(tasks[4].script.empty());
}

TEST_CASE("What waits or runs is known by its script, and not sent again", "[study]") {
  StudyBench bench;
  const Plan plan = bench.plan(kValues);
  const Store store(bench.folder);
  StudyState progress = bench.progress(plan);
  Paper paper;
  const BatchOptions options = options_of(bench, 200.0);
  const Batch batch = plan_batch(plan, store, progress, {}, paper.scheduler, options);
  CHECK(batch.folder == bench.folder / "paper/1");
  CHECK(batch.stages == 16);
  CHECK(send(batch, paper.scheduler) == std::vector<std::string>{"1", "2", "3"});
  CHECK(paper.sent ==
        std::vector<std::string>{"shared after nothing", "rows after 1", "report after 2"});
  const auto tasks = read_array(batch.folder / "rows.json").tasks;
  REQUIRE(tasks.size() > 1);
  // The first task waits, under another name of the same folder; somebody else's runs too.
  std::filesystem::create_directory_symlink(bench.folder, bench.scratch / "link");
  const UnderWay found = under_way(
      bench.folder, paper.scheduler,
      {{.job = "2", .script = bench.scratch / "link/paper/1/rows.txt", .task = 0},
       {.job = "3", .script = batch.folder / "report.txt"},
       {.job = "4", .script = "/elsewhere/rows.txt", .running = true},
       {.job = "5", .script = batch.folder / "rows.txt", .task = 1000000, .running = true}});
  CHECK(found.waiting == 1);
  CHECK(found.running == 0);
  CHECK(found.jobs.size() == tasks[0].size());
  const Batch rest = plan_batch(plan, store, progress, found, paper.scheduler, options);
  CHECK(rest.folder == bench.folder / "paper/2");
  CHECK(rest.stages == 16 - tasks[0].size());
  for (const ArrayRecord& record : rest.records)
    for (const auto& task : record.tasks)
      for (const std::string& recipe : task) CHECK_FALSE(found.jobs.contains(recipe));
  CHECK(rest.after.empty());
  // What is shared waits: the rows begin after it.
  const UnderWay shared = under_way(bench.folder, paper.scheduler,
                                    {{.job = "1", .script = batch.folder / "shared.txt"}});
  CHECK(plan_batch(plan, store, progress, shared, paper.scheduler, options).after ==
        std::vector<std::string>{"1"});
}

TEST_CASE("What is done is not sent, and what takes seconds is done before", "[study]") {
  StudyBench bench;
  const Plan plan = bench.plan(kValues + "  keep: frames\n");
  bench.run(plan);
  const Store store(bench.folder);
  StudyState progress = bench.progress(plan);
  const Paper paper;
  CHECK(plan_batch(plan, store, progress, {}, paper.scheduler, options_of(bench, 1.0))
            .scripts.empty());
  // One more value of the last: its inputs are there, but for one whose files have gone.
  const Plan more = bench.plan(
      "  vary:\n    one: {setting: stages.one.with.value, values: [1, 2, 3]}\n"
      "    factor: {setting: stages.sum.with.factor, values: [1, 10, 100]}\n  keep: frames\n");
  StudyState now = bench.progress(more);
  const std::size_t one = more.rows[0].nodes[0];
  store.drop_files("one", now.node(one).key);
  const Batch batch = plan_batch(more, store, now, {}, paper.scheduler, options_of(bench, 1e6));
  REQUIRE(batch.records.size() == 1);
  CHECK(batch.records[0].tasks.size() == 1);
  CHECK(batch.stages == 7);
  CHECK(nodes_of_task(more, batch.records[0], 0)[one]);
}

TEST_CASE("What rows share and is little is for whoever sends the rest", "[study]") {
  StudyBench bench;
  const Plan plan = bench.plan(kValues);
  const Store store(bench.folder);
  StudyState progress = bench.progress(plan);
  const Paper paper;
  const auto here = [&](double chunk) {
    return plan_batch(plan, store, progress, {}, paper.scheduler, options_of(bench, chunk)).here;
  };
  // A minute for each: `two`, which all share, is a thirtieth of half an hour, and then all is one
  // task, which nothing comes before.
  CHECK(here(200.0).empty());
  CHECK(here(1800.0).empty());
  bench.run(plan);
  std::filesystem::remove_all(bench.folder / "stages/sum");
  std::filesystem::remove_all(bench.folder / "stages/count");
  std::filesystem::remove_all(bench.folder / "stages/two");
  // Numbers took milliseconds, the rest is unknown; of what is open only `two` is shared.
  StudyState some = bench.progress(plan);
  const Batch batch = plan_batch(plan, store, some, {}, paper.scheduler, options_of(bench, 50.0));
  REQUIRE(batch.here.size() == plan.nodes.size());
  for (std::size_t n = 0; n < plan.nodes.size(); ++n)
    CHECK(batch.here[n] == (plan.nodes[n].stage.name == "two"));
  CHECK(batch.scripts.size() == 2);
}

TEST_CASE("A record of an array says what is wrong with it", "[study]") {
  const Scratch scratch;
  CHECK_THROWS_WITH(read_array(scratch / "none.json"),
                    Contains("must lie where every machine of the cluster sees it"));
  scratch.write("bad.json", "{}");
  CHECK_THROWS_AS(read_array(scratch / "bad.json"), InputError);
  ArrayRecord record;
  record.tasks = {{std::string(64, 'a')}, {}};
  write_array(scratch / "good.json", record);
  CHECK(read_array(scratch / "good.json").tasks == record.tasks);
  record.tasks = {{"../../etc"}};
  write_array(scratch / "evil.json", record);
  CHECK_THROWS_WITH(read_array(scratch / "evil.json"), Contains("is no digest"));
  const StudyBench bench;
  CHECK_THROWS_WITH(nodes_of_task(bench.plan(""), record, 1), Contains("there is no task 1"));
}

TEST_CASE("Tasks of a cluster, one after the other, make the table of the pool", "[study]") {
  StudyBench pool;
  const std::string expected = pool.run(kValues);
  StudyBench bench;
  const Plan plan = bench.plan(kValues);
  StudyState progress = bench.progress(plan);
  Paper paper;
  const Batch batch = plan_batch(plan, Store(bench.folder), progress, {}, paper.scheduler,
                                 options_of(bench, 200.0));
  std::string csv;
  std::size_t made = 0;
  for (const ArrayRecord& record : batch.records)
    for (std::size_t task = 0; task < record.tasks.size(); ++task) {
      bench.only = nodes_of_task(plan, record, task);
      csv = bench.run(plan);
      made += record.tasks[task].size();
      CHECK(bench.made().size() == made);
    }
  CHECK(csv == expected);
  CHECK_FALSE(bench.made_twice());
}

TEST_CASE("A task waits a while for what others have made to be seen", "[study]") {
  StudyBench bench;
  const Plan plan = bench.plan("");
  const Row& row = plan.rows[0];
  bench.only.assign(plan.nodes.size(), false);
  bench.only[row.nodes[2]] = bench.only[row.nodes[3]] = true;
  CHECK_THAT(bench.run(plan), !Contains("done"));
  CHECK(bench.made().empty());
  bench.patience = 20.0;
  const pid_t late = bench.start(plan);
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  bench.only.flip();
  bench.run(plan);
  int status = 0;
  ::waitpid(late, &status, 0);
  CHECK(status == 0);
  CHECK(bench.progress(plan).row_state(row) == State::done);
}
