#include "tests/cli/program.hpp"

#include <nlohmann/json.hpp>

using namespace flowslide;
using namespace flowslide::cli::test;
using Catch::Contains;

namespace {

/// Doubles of Slurm: sbatch runs a script at once, task by task, or refuses it; squeue says what
/// the file `queue` says. A real Slurm: tests/study/slurm.
struct Doubles {
  Scratch scratch;
  std::string before = "PATH=\"$PWD/bin:/usr/bin:/bin\" && ";

  Doubles() {
    write_model(scratch);
    scratch.write("w.yaml", "schema: 1\nname: w\nstages:\n" + shake());
    write_study("[{rule: mean}, {rule: elastic, nu: 0.3}]");
    program("squeue", "cat \"$HOME/queue\"");
    program("sbatch",
            "echo \"$@\" >>\"$HOME/sent\"\n"
            "for script; do :; done\n"
            "last=$(sed -n 's/^#SBATCH --array=0-//p' \"$script\")\n"
            "for task in $(seq 0 \"${last:-0}\"); do\n"
            "  SLURM_ARRAY_TASK_ID=$task bash \"$script\" >>\"$HOME/log\" 2>&1\n"
            "done\n"
            "echo 'welcome to the cluster'\n"
            "echo \"$(wc -l <\"$HOME/sent\");north\"");
    scratch.write("queue", "");
    before = "HOME=\"$PWD\" && export HOME && " + before;
  }
  void program(const std::string& name, const std::string& text) {
    std::filesystem::create_directories(scratch / "bin");
    const auto path = scratch.write("bin/" + name, "#!/bin/bash\n" + text + "\n");
    std::filesystem::permissions(path, std::filesystem::perms::owner_all);
  }
  void write_study(const std::string& values) {
    scratch.write("s.yaml",
                  "schema: 1\nname: s\nstudy:\n  workflow: w.yaml\n  vary:\n    rule: "
                  "{setting: stages.shake.with.sigma_zz, values: " +
                      values + "}\n  slurm: {chunk: 0.001 s, options: [--qos=low]}\n");
  }
  [[nodiscard]] Outcome run(const std::string& more = "") const {
    return call(scratch, "study run s.yaml --executor slurm " + more, before);
  }
  [[nodiscard]] std::string sent() const { return read_text_file(scratch / "sent"); }
};

}  // namespace

TEST_CASE("a study is sent as jobs, which make the table of the pool", "[cli]") {
  const Doubles slurm;
  REQUIRE(call(slurm.scratch, "study run s.yaml --out local").code == 0);
  const Outcome o = slurm.run();
  INFO(o.err);
  REQUIRE(o.code == 0);
  CHECK_THAT(o.out, Contains("rows                     job 1, 2 tasks") &&
                        Contains("report                   job 2, 1 task"));
  CHECK_THAT(slurm.sent(), Contains("--parsable --dependency=afterany:1 "));
  INFO(read_text_file(slurm.scratch / "log"));
  CHECK(read_text_file(slurm.scratch / "runs/s/table.csv") ==
        read_text_file(slurm.scratch / "local/table.csv"));
  CHECK(std::filesystem::exists(slurm.scratch / "runs/s/study.html"));
  // Nothing is left: the study is finished here.
  const Outcome again = slurm.run();
  CHECK(again.code == 0);
  CHECK_THAT(again.out, Contains("2 done, 0 failed"));
  CHECK(slurm.sent().find("afterany") == slurm.sent().rfind("afterany"));
}

TEST_CASE("what would be sent can be read before, and changes nothing", "[cli]") {
  const Doubles slurm;
  const Outcome o = slurm.run("--dry-run");
  REQUIRE(o.code == 0);
  CHECK_THAT(o.out, Contains("#SBATCH --array=0-1\n") && Contains("#SBATCH --qos=low\n") &&
                        Contains("rows=$(sbatch --parsable rows.sbatch)\n"));
  CHECK_FALSE(std::filesystem::exists(slurm.scratch / "runs"));
  CHECK(slurm.sent().empty());
  // Also where there is no Slurm.
  const Outcome here =
      call(slurm.scratch, "study run s.yaml --executor slurm --dry-run", "export PATH=/none && ");
  CHECK(here.code == 0);
  CHECK(here.out == o.out);
  CHECK_THAT(here.err, Contains("squeue: there is no such program"));
}

TEST_CASE("what waits is not sent again, and status tells of it", "[cli]") {
  Doubles slurm;
  slurm.program("sbatch", "echo $@ >>\"$HOME/sent\"; echo 7");
  REQUIRE(slurm.run("--quiet").out.empty());
  const std::string sent = slurm.sent(),
                    script = (slurm.scratch / "runs/s/slurm/1/rows.sbatch").string();
  slurm.scratch.write("queue", "7|0|R|" + script + "\n7|1|PD|" + script + "\n");
  const Outcome o = slurm.run();
  CHECK(o.code == 0);
  CHECK_THAT(o.out, Contains("2 stages wait or run already: 1 task runs, 1 waits (squeue --me)"));
  CHECK(slurm.sent() == sent);
  CHECK_THAT(call(slurm.scratch, "study status runs/s", slurm.before).out,
             Contains("slurm: 1 task runs, 1 waits (squeue --me)"));
  const auto status =
      nlohmann::json::parse(call(slurm.scratch, "study status runs/s --json", slurm.before).out);
  CHECK(status["slurm"]["running"] == 1);
  CHECK(status["slurm"]["waiting"] == 1);
  // One has ended without a result.
  slurm.scratch.write("queue", "7|0|R|" + script + "\n");
  const Outcome json = slurm.run("--json");
  CHECK_THAT(json.out, Contains(R"("event":"sent","stages":1)"));
}

TEST_CASE("what Slurm refuses is told in its words", "[cli]") {
  Doubles slurm;
  slurm.program("sbatch", "echo 'sbatch: error: invalid partition specified: night' >&2; exit 1");
  Outcome o = slurm.run();
  CHECK(o.code == 4);
  CHECK_THAT(o.err, Contains("sbatch refused it (invalid partition specified: night). Mend"));
  slurm.program("sbatch", "exit 3");
  CHECK_THAT(slurm.run().err, Contains("(exit code 3, without a word)"));
  slurm.program("squeue", "echo 'slurm_load_jobs error: Unable to contact controller' >&2; exit 1");
  o = slurm.run();
  CHECK(o.code == 4);
  CHECK_THAT(o.err, Contains("Unable to contact controller"));
  o = call(slurm.scratch, "study run s.yaml --executor slurm", "export PATH=/none && ");
  CHECK(o.code == 4);
  CHECK_THAT(o.err, Contains("squeue: there is no such program") && Contains("login node"));
  o = slurm.run("--jobs 2");
  CHECK(o.code == 2);
  CHECK_THAT(o.err, Contains("slurm: {cpus: ...}"));
}

TEST_CASE("a task says what it lacks", "[cli]") {
  Doubles slurm;
  slurm.program("sbatch", "echo 7");
  REQUIRE(slurm.run().code == 0);
  Outcome o = call(slurm.scratch, "study part nowhere/slurm/1/rows.json 0");
  CHECK(o.code == 4);
  CHECK_THAT(o.err, Contains("must lie where every machine of the cluster sees it"));
  o = call(slurm.scratch, "study part runs/s/slurm/1/rows.json 2");
  CHECK(o.code == 2);
  CHECK_THAT(o.err, Contains("there is no task 2"));
  o = call(slurm.scratch, "study part runs/s/slurm/1/rows.json 1");
  CHECK(o.code == 0);
  CHECK_THAT(o.out, Contains("task 1: 1 of 1 stages done, 0 failed"));
  // A workflow that was edited since the jobs were sent.
  slurm.scratch.write("w.yaml",
                      "schema: 1\nname: w\nstages:\n" + shake("{length: m, time: s, stress: MPa}"));
  o = call(slurm.scratch, "study part runs/s/slurm/1/rows.json 0");
  CHECK(o.code == 2);
  CHECK_THAT(o.err, Contains("has changed since the study was planned"));
}
