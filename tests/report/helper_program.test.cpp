#include "report/helper_program.hpp"

#include "core/check.hpp"
#include "tests/support/scratch.hpp"

#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <sys/wait.h>
#include <thread>

#include <catch2/catch.hpp>

using namespace flowslide;

namespace {

using Clock = std::chrono::steady_clock;

struct Bench {
  Scratch scratch;
  [[nodiscard]] HelperRun shell(const std::string& script, double seconds) const {
    return {.arguments = {"sh", "-c", script},
            .folder = scratch.path(),
            .log = scratch / "log",
            .seconds = seconds};
  }
  [[nodiscard]] pid_t pid(const std::string& file) const {
    return static_cast<pid_t>(std::atoi(read_text_file(scratch / file).c_str()));
  }
};

/// Waits up to two seconds; the dead are those that are gone or only wait to be counted.
bool is_dead(pid_t pid) {
  for (int i = 0; i < 200; ++i) {
    const std::string stat = read_text_file("/proc/" + std::to_string(pid) + "/stat");
    const auto name_end = stat.rfind(')');
    if (name_end == std::string::npos || stat[name_end + 2] == 'Z') return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return false;
}

}  // namespace

TEST_CASE("a helper's status and words come back") {
  const Bench b;
  const HelperOutcome outcome = run_helper(b.shell("pwd; echo no >&2; exit 7", 60.0), {});
  CHECK(outcome.status == 7);
  CHECK_FALSE(outcome.timed_out);
  CHECK(read_text_file(b.scratch / "log") == b.scratch.path().string() + "\nno\n");
  CHECK(run_helper(b.shell("kill -9 $$", 60.0), {}).status == 128 + SIGKILL);
  CHECK(run_helper({{"no-such-program"}, b.scratch.path(), b.scratch / "log", 1.0}, {}).status ==
        127);
}

TEST_CASE("a helper is ended, with what it has started, at its time limit") {
  const Bench b;
  const auto start = Clock::now();
  const HelperOutcome outcome =
      run_helper(b.shell("sleep 1000 & echo $! >other; echo $$ >own; wait", 0.5), {});
  CHECK(outcome.timed_out);
  CHECK(std::chrono::duration<double>(Clock::now() - start).count() < 5.0);
  CHECK(is_dead(b.pid("own")));
  CHECK(is_dead(b.pid("other")));
}

TEST_CASE("a helper is ended by a request to stop") {
  const Bench b;
  std::atomic<bool> stop = false;
  std::thread user([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
    stop = true;
  });
  Progress progress;
  progress.stop_requested = &stop;
  CHECK_THROWS_AS(run_helper(b.shell("echo $$ >own; sleep 1000", 60.0), progress), Interrupted);
  user.join();
  CHECK(is_dead(b.pid("own")));
}

TEST_CASE("a helper dies with a program that is killed") {
  const Bench b;
  const pid_t child = ::fork();
  if (child == 0) {
    run_helper(b.shell("echo $$ >own; exec sleep 1000", 60.0), {});
    ::_exit(0);
  }
  for (int i = 0; i < 500 && b.pid("own") == 0; ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  const pid_t helper = b.pid("own");
  REQUIRE(helper > 0);
  ::kill(child, SIGKILL);
  ::waitpid(child, nullptr, 0);
  CHECK(is_dead(helper));
}

TEST_CASE("a name is not looked for in the working folder") {
  const Bench b;
  b.scratch.write("own-program", "#!/bin/sh\nexit 5\n");
  std::filesystem::permissions(b.scratch / "own-program", std::filesystem::perms::owner_all);
  const std::filesystem::path before = std::filesystem::current_path();
  const std::string path = std::getenv("PATH") ? std::getenv("PATH") : "";
  std::filesystem::current_path(b.scratch.path());
  ::setenv("PATH", (".::" + path).c_str(), 1);
  const int status =
      run_helper({{"own-program"}, b.scratch.path(), b.scratch / "log", 60.0}, {}).status;
  ::setenv("PATH", path.c_str(), 1);
  std::filesystem::current_path(before);
  CHECK(status == 127);
}
