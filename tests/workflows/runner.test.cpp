#include "workflows/engine/runner.hpp"

#include "core/check.hpp"
#include "core/hash.hpp"
#include "tests/workflows/run_bench.hpp"
#include "workflows/engine/lock.hpp"
#include "workflows/engine/run_folder.hpp"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

using namespace flowslide;
using Catch::Contains;
using nlohmann::json;

namespace {

using Bench = sample::RunBench;
using Names = std::vector<std::string>;

}  // namespace

TEST_CASE("only what is not up to date runs, and says why", "[workflows]") {
  Bench bench;
  bench.run();
  CHECK(bench.ran == Names{"one", "two", "sum"});
  CHECK(bench.why["sum"] == "no result yet");
  CHECK(bench.result()["sum"] == 3.0);

  bench.run();
  CHECK(bench.ran.empty());
  CHECK(bench.why["sum"] == "up to date");

  bench.run({"stages.sum.with.factor=2"});
  CHECK(bench.ran == Names{"sum"});
  CHECK(bench.why["sum"] == "settings changed (factor 1 -> 2)");
  CHECK(bench.result()["sum"] == 6.0);

  SECTION("going back costs nothing") {
    bench.run();
    CHECK(bench.ran.empty());
    CHECK_THAT(bench.why["sum"], Contains("earlier result"));
    CHECK(bench.result()["sum"] == 3.0);
  }
  SECTION("a changed input is passed on") {
    bench.run({"stages.sum.with.factor=2", "stages.two.with.value=5"});
    CHECK(bench.ran == Names{"two", "sum"});
    CHECK(bench.why["sum"] == "input changed (b)");
    CHECK(bench.result()["sum"] == 12.0);
  }
  SECTION("an output that comes out the same stops the chain") {
    bench.run({"stages.sum.with.factor=2", "stages.two.with.value=2.1"});
    CHECK(bench.ran == Names{"two"});
  }
  SECTION("the content of a named file counts") {
    bench.note = "second note";
    bench.run({"stages.sum.with.factor=2"});
    CHECK(bench.ran == Names{"one"});
    CHECK(bench.why["one"] == "settings changed (content of note)");
  }
  SECTION("a new version of a stage runs again") {
    bench.types[1].version = 2;
    bench.run({"stages.sum.with.factor=2"});
    CHECK(bench.ran == Names{"sum"});
    CHECK(bench.why["sum"] == "program's stage version changed 1 -> 2");
  }
}

TEST_CASE("a damaged or missing result is made anew", "[workflows]") {
  Bench bench;
  bench.run();
  const auto file = bench.folder(2) / "sum.txt";
  SECTION("missing") {
    std::filesystem::remove(file);
    bench.run();
    CHECK_THAT(bench.why["sum"], Contains("sum.txt is missing"));
  }
  SECTION("another size") {
    std::ofstream(file) << "33333\n";
    bench.run();
    CHECK_THAT(bench.why["sum"], Contains("sum.txt has 6 bytes, not 2"));
  }
  SECTION("same size, other content") {
    std::ofstream(file) << "4\n";
    bench.run();
    CHECK_THAT(bench.why["sum"], Contains("content of sum.txt has changed"));
  }
  SECTION("a copied run folder is still up to date") {
    std::ofstream(file) << "3\n";
    bench.run();
    CHECK(bench.ran.empty());
    return;
  }
  CHECK(bench.ran == Names{"sum"});
  CHECK(read_text_file(file) == "3\n");
}

TEST_CASE("result.json holds what stages found and what each of them took", "[workflows]") {
  Bench bench;
  bench.run();
  bench.run({"stages.sum.with.factor=2"});
  const json r = bench.result();
  for (const char* name : {"runout_m", "wall_s", "stages", "headlines"}) CHECK(r.contains(name));
  CHECK(r["runout_m"] == 1.5);                 // both numbers say the same
  CHECK_FALSE(r.contains("transfer_time_s"));  // no stage of this workflow knows of it
  CHECK(r["stages"]["one"]["cached"] == true);
  CHECK(r["stages"]["sum"]["cached"] == false);
  CHECK(r["stages"]["sum"]["facts"]["sum"] == 6.0);
  double sum = 0.0;
  for (const auto& stage : r["stages"]) sum += stage["seconds"].get<double>();
  CHECK(r["wall"]["stages_s"] == Approx(sum));
  CHECK(r["wall_s"] == Approx(sum + r["wall"]["overhead_s"].get<double>()));
}

TEST_CASE("a failed run leaves nothing at the top that looks current", "[workflows]") {
  Bench bench;
  bench.run();
  REQUIRE(std::filesystem::exists(bench.out / "sum.pvd"));
  CHECK_THROWS_AS(bench.run({"stages.sum.with.fail=true"}), Error);
  CHECK_THROWS_WITH(bench.run({"stages.sum.with.fail=true"}),
                    Contains("sum: the sum did not converge"));
  CHECK_FALSE(std::filesystem::exists(bench.out / "result.json"));
  CHECK_FALSE(std::filesystem::exists(std::filesystem::symlink_status(bench.out / "sum.pvd")));
  CHECK_FALSE(std::filesystem::exists(std::filesystem::symlink_status(bench.out / "view")));
  bench.run();
  CHECK(bench.ran.empty());
  CHECK(std::filesystem::exists(bench.out / "result.json"));
}

TEST_CASE("published files work from the top of the run folder", "[workflows]") {
  Bench bench;
  bench.run();
  const std::string pvd = read_text_file(bench.out / "sum.pvd");
  const auto begin = pvd.find("file=\"") + 6;
  const auto target = pvd.substr(begin, pvd.find('"', begin) - begin);
  CHECK_FALSE(std::filesystem::path(target).is_absolute());
  CHECK(read_text_file(bench.out / target) == "3");
  CHECK(read_text_file(bench.out / "view/1.vtu") == "3");
  std::filesystem::rename(bench.out, bench.scratch / "moved");
  CHECK(read_text_file(bench.scratch / "moved/view/1.vtu") == "3");
}

TEST_CASE("a plan changes nothing", "[workflows]") {
  Bench bench;
  auto plan = plan_workflow(bench.load(), bench.out);
  CHECK(plan[2].decision.action == Action::undecided);
  CHECK(plan[2].decision.why == "no result yet");
  CHECK_FALSE(std::filesystem::exists(bench.out));
  bench.run();
  plan = plan_workflow(bench.load({"stages.one.with.value=4"}), bench.out);
  CHECK(plan[0].decision.why == "settings changed (value 1 -> 4)");
  CHECK(plan[1].decision.action == Action::reuse);
  CHECK(plan[2].decision.why == "input may change (a)");
}

TEST_CASE("a run folder belongs to one process and is not taken from others", "[workflows]") {
  Bench bench;
  {
    const RunFolder holder(bench.out);
    CHECK_THROWS_WITH(bench.run(), Contains("in use by another run"));
    CHECK_THROWS_AS(bench.run(), FileError);
  }
  bench.run();
  const Scratch foreign;
  foreign.write("result.json", "{}");
  CHECK_THROWS_WITH(RunFolder(foreign.path()), Contains("no run of flowslide"));
  foreign.write("file", "x");
  CHECK_THROWS_AS(RunFolder(foreign / "file"), FileError);
}

TEST_CASE("a stage that is asked for runs again, and says so", "[workflows]") {
  Bench bench;
  bench.run();
  bench.redo = {"two"};
  bench.run();
  CHECK(bench.ran == Names{"two"});
  CHECK(bench.why["two"] == "asked for");
  CHECK(bench.result()["sum"] == 3.0);
}

TEST_CASE("a result of another build is used, and the build is named", "[workflows]") {
  Bench bench;
  bench.run();
  const auto folder = bench.folder(1);
  auto record = *read_stage_record(folder).record;
  record.program = "flowslide 0.0.1 (abc1234)";
  std::erase_if(record.files, [](const FileRecord& f) { return f.name == kFactsFile; });
  write_record(folder, record);
  bench.run();
  CHECK(bench.ran.empty());
  CHECK(bench.why["two"] == "up to date (made by 0.0.1 abc1234; --redo two runs it again)");
  CHECK(bench.why["one"] == "up to date");
}

TEST_CASE("what is refused takes nothing away", "[workflows]") {
  Bench bench;
  bench.run();
  const auto before = sample::contents(bench.out);
  const std::string result = read_text_file(bench.out / "result.json");
  CHECK_THROWS_AS(bench.run({"stages.sum.with.factr=2"}), InputError);
  CHECK_THROWS_AS(bench.run({"stages.one.with.value=13"}), InputError);
  CHECK_THROWS_AS(bench.run({"stages.one.with.note=nowhere.txt"}), FileError);
  {
    const RunFolder holder(bench.out);
    CHECK_THROWS_AS(bench.run({"stages.sum.with.factor=2"}), FileError);
  }
  CHECK(sample::contents(bench.out) == before);
  CHECK(read_text_file(bench.out / "result.json") == result);
}

TEST_CASE("a result stays until a stage has to run, and goes with a word", "[workflows]") {
  Bench bench;
  bench.run();
  CHECK(bench.notices.empty());
  bool there = true;
  bench.before_stage = [&](std::string_view) {
    there = std::filesystem::exists(bench.out / "result.json");
  };
  CHECK_THROWS_AS(bench.run({"stages.sum.with.fail=true"}), Error);
  CHECK(there);  // the decision is told before anything goes
  CHECK_FALSE(std::filesystem::exists(bench.out / "result.json"));
  CHECK_THAT(bench.told(), Contains("result.json of the earlier run goes"));
  bench.run();
  CHECK(bench.ran.empty());
  CHECK(bench.result()["sum"] == 3.0);
}

TEST_CASE("a script that the user has changed stays", "[workflows]") {
  Bench bench;
  bench.run();
  const auto pen = bench.out / "style/pen.txt";
  CHECK(read_text_file(pen) == "blue\n");
  SECTION("edited: it is kept, whatever runs") {
    bench.scratch.write("out/style/pen.txt", "red\n");
    bench.scratch.write("out/style/own.txt", "mine\n");
    bench.run();
    CHECK(bench.ran.empty());
    CHECK_THAT(bench.told(), Contains("style/pen.txt was changed and is kept"));
    bench.run({"stages.sum.with.factor=2"});
    CHECK(read_text_file(pen) == "red\n");
    CHECK(read_text_file(bench.out / "style/own.txt") == "mine\n");
    std::filesystem::remove(pen);
    bench.run();
    CHECK(read_text_file(pen) == "blue\n");
    CHECK(bench.notices.empty());
  }
  SECTION("not edited: a new version of the program brings its own") {
    auto lock = *read_lock(bench.out).lock;
    bench.scratch.write("out/style/pen.txt", "of an earlier version\n");
    lock.given["style/pen.txt"] = sha256("of an earlier version\n");
    write_lock(bench.out, lock);
    bench.run();
    CHECK(bench.notices.empty());
    CHECK(read_text_file(pen) == "blue\n");
  }
}

TEST_CASE("a program that a workflow names needs the user's word", "[workflows]") {
  Bench bench;
  Workflow workflow = bench.load();
  workflow.stages[2].prepared.programs = {"/opt/python"};
  CHECK_THROWS_WITH(run_workflow(workflow, {.folder = bench.out}, {}),
                    Contains("--allow-python '/opt/python'"));
  CHECK_THROWS_AS(run_workflow(workflow, {.folder = bench.out, .allowed_programs = {"/opt"}}, {}),
                  InputError);
  CHECK_FALSE(std::filesystem::exists(bench.out));
  run_workflow(workflow, {.folder = bench.out, .allowed_programs = {"/opt/python"}}, {});
  CHECK(std::filesystem::exists(bench.out / "result.json"));
}
