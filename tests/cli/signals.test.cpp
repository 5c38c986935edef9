#include "tests/cli/program.hpp"

#include <chrono>
#include <csignal>
#include <thread>

using namespace flowslide;
using namespace flowslide::cli::test;
using Catch::Contains;

namespace {

/// A runout of about two seconds.
std::string long_run() {
  return "run " + test::source("workflows/mochikoshi-static.yaml") +
         " --out out --threads 1 --set stages.flow.with.cell='2.5 m' --set "
         "stages.report.with.figures=false";
}

/// Waits until the flow computes.
void await_flow(const std::filesystem::path& flow) {
  for (int tries = 0; tries < 2000; ++tries) {
    if (std::filesystem::exists(flow))
      for (const auto& entry : std::filesystem::directory_iterator(flow))
        if (std::filesystem::exists(entry.path() / "mpm.h5.partial/samples.bin")) return;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  FAIL("the flow has not begun");
}

}  // namespace

TEST_CASE("a terminal that closes stops a run, which goes on later", "[cli]") {
  const Scratch scratch;
  const std::string exec = "cd '" + scratch.path().string() +
                           "' && export XDG_CACHE_HOME=\"$PWD/cache\" && exec " FLOWSLIDE_BINARY
                           " " +
                           long_run() + " >out.txt 2>err.txt";
  const pid_t child = ::fork();
  REQUIRE(child >= 0);
  if (child == 0) {
    ::execl("/bin/sh", "sh", "-c", exec.c_str(), nullptr);
    ::_exit(127);
  }
  await_flow(scratch / "out/stages/flow");
  ::kill(child, SIGHUP);
  ::kill(child, SIGHUP);  // shells tell their jobs beside the system
  int status = 0;
  ::waitpid(child, &status, 0);
  REQUIRE(WIFEXITED(status));
  CHECK(WEXITSTATUS(status) == 130);
  CHECK_THAT(read_text_file(scratch / "err.txt"),
             Contains("the same command continues from there"));
  CHECK_FALSE(std::filesystem::exists(scratch / "out/result.json"));
  const Outcome again = call(scratch, long_run());
  CHECK(again.code == 0);
  CHECK_THAT(again.out, Contains("flow     goes on") || Contains("continue"));
}

TEST_CASE("a reader that goes away loses no result", "[cli]") {
  const Scratch scratch;
  write_model(scratch);
  scratch.write("w.yaml", "schema: 1\nname: w\nstages:\n" + shake());
  const std::string command = "cd '" + scratch.path().string() +
                              "' && export XDG_CACHE_HOME=\"$PWD/cache\" && { " FLOWSLIDE_BINARY
                              " run w.yaml --out out 2>err.txt; echo $? >code.txt; } | true";
  REQUIRE(std::system(command.c_str()) == 0);
  for (int tries = 0; tries < 1000 && !std::filesystem::exists(scratch / "code.txt"); ++tries)
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  CHECK_THAT(read_text_file(scratch / "err.txt"), Contains("who reads it has gone"));
  CHECK(read_text_file(scratch / "code.txt") == "4\n");
  CHECK(call(scratch, "run w.yaml --out out").code == 0);
}

TEST_CASE("warnings that cannot be written are not passed over", "[cli]") {
  const Scratch scratch;
  write_model(scratch);
  scratch.write("stress.out", "0.1 -40 -80 0\n");
  scratch.write("w.yaml", "schema: 1\nname: w\nstages:\n" + shake());
  const auto without_errors = [&] {
    const std::string command = "cd '" + scratch.path().string() +
                                "' && " FLOWSLIDE_BINARY " check w.yaml >out.txt 2>/dev/full";
    return WEXITSTATUS(std::system(command.c_str()));
  };
  CHECK(without_errors() == 0);  // control: it has nothing to say
  scratch.write("stress.out", "0.1 -100000 -200000 0\n");
  CHECK(without_errors() == 4);
}

TEST_CASE("a file larger than the system allows is a matter of files", "[cli]") {
  const Scratch scratch;
  write_model(scratch);
  scratch.write("w.yaml", "schema: 1\nname: w\nstages:\n" + shake());
  const Outcome o = call(scratch, "run w.yaml --out out", "ulimit -f 4 && ");
  CHECK(o.code == 4);
  CHECK_THAT(o.err, Contains("File too large"));
  check_nothing_final(scratch);
  CHECK(call(scratch, "run w.yaml --out out").code == 0);
}
