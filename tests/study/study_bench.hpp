#pragma once
#include "study/page/page.hpp"
#include "study/plan/plan.hpp"
#include "study/run/pool.hpp"
#include "study/table/table.hpp"
#include "tests/support/scratch.hpp"
#include "tests/workflows/sample_stages.hpp"

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <fcntl.h>
#include <map>
#include <sstream>
#include <string>
#include <sys/wait.h>
#include <unistd.h>
#include <vector>

#include <catch2/catch.hpp>

/// A study of small stages: one, two -> sum, one -> count.
namespace flowslide::study::sample {

inline constexpr std::string_view kWorkflow =
    "schema: 1\nname: demo\nstages:\n"
    "  one: {uses: sample.number, with: {value: 1}}\n"
    "  two: {uses: sample.number, with: {value: 2}}\n"
    "  sum: {uses: sample.sum, in: {a: one.number, b: two.number}}\n"
    "  count: {uses: sample.count, in: {start: sum.sum}, with: {steps: 20}}\n";

struct StudyBench {
  Scratch scratch;
  std::filesystem::path folder = scratch / "study", log = scratch / "log.txt";
  std::vector<StageType> types = flowslide::sample::stages();
  std::size_t jobs = 2;
  bool retry = false;
  std::vector<bool> only = {};
  double patience = 0.0;
  std::filesystem::path costs = {};
  const std::atomic<bool>* stop = nullptr;
  std::function<void(const Job&)> before = [](const Job&) {};  ///< in the process of the stage
  std::vector<std::string> notices;
  PoolEnd end = PoolEnd::done;  ///< of the last run

  explicit StudyBench(const std::string& workflow = std::string(kWorkflow)) {
    scratch.write("base.yaml", workflow);
  }

  Plan plan(const std::string& study) const {
    return make_plan(read_study(scratch.write("study.yaml",
                                              "schema: 1\nname: demo\nstudy:\n"
                                              "  workflow: base.yaml\n" +
                                                  study)),
                     types);
  }

  /// Runs what is missing; the table as CSV.
  std::string run(const Plan& p) {
    std::filesystem::create_directories(folder / "stages");
    const Store store(folder);
    StudyState progress(p, store);
    PoolOptions options{.jobs = jobs,
                        .threads = jobs,
                        .memory = 1e12,
                        .retry = retry,
                        .only = only,
                        .patience = patience,
                        .allowed_programs = {},
                        .costs = costs,
                        .stop_requested = stop,
                        .body = {}};
    options.body = [this](const Job& job) {
      before(job);
      const JobResult result = run_job_aloud(job, types, stop);
      if (result.end == JobEnd::made) note(job.stage + " " + job.key);
      return 0;
    };
    PoolEvents events;
    events.notice = [this](std::string_view text) { notices.emplace_back(text); };
    end = run_pool(p, store, progress, options, events);
    return to_csv(make_table(p, progress));
  }

  std::string run(const std::string& study) { return run(plan(study)); }

  StudyState progress(const Plan& p) const { return {p, Store(folder)}; }

  /// The same in a process of its own.
  pid_t start(const Plan& p) {
    const pid_t child = ::fork();
    if (child == 0) {
      int code = 0;
      try {
        run(p);
      } catch (...) {
        code = 9;
      }
      ::_exit(code);
    }
    return child;
  }

  /// Stages that were computed to their end so far, each "name key".
  [[nodiscard]] std::vector<std::string> made() const {
    std::vector<std::string> lines;
    std::istringstream in(read_text_file(log));
    for (std::string line; std::getline(in, line);) lines.push_back(line);
    return lines;
  }
  [[nodiscard]] std::map<std::string, int> made_by_stage() const {
    std::map<std::string, int> count;
    for (const std::string& line : made()) ++count[line.substr(0, line.find(' '))];
    return count;
  }
  [[nodiscard]] bool made_twice() const {
    std::vector<std::string> lines = made();
    std::sort(lines.begin(), lines.end());
    return std::adjacent_find(lines.begin(), lines.end()) != lines.end();
  }

 private:
  void note(const std::string& line) const {
    const int file = ::open(log.c_str(), O_WRONLY | O_CREAT | O_APPEND, 0666);
    const std::string text = line + "\n";
    [[maybe_unused]] const auto written = ::write(file, text.data(), text.size());
    ::close(file);
  }
};

inline const std::string kValues =
    "  vary:\n"
    "    one: {setting: stages.one.with.value, values: [1, 2, 3]}\n"
    "    factor: {setting: stages.sum.with.factor, values: [1, 10]}\n";

}  // namespace flowslide::study::sample
