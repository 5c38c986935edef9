#include "cli/study_pool.hpp"

#include "cli/processors.hpp"
#include "cli/signals.hpp"
#include "core/check.hpp"
#include "core/memory.hpp"
#include "workflows/engine/cost_book.hpp"
#include "workflows/engine/program_version.hpp"

#include <array>
#include <unistd.h>

namespace flowslide::cli {
namespace {

/// The same program again, with the job as its argument: it shows in the list of processes, and can
/// be repeated by hand.
int become_stage(const study::Job& job) {
  std::string program = "flowslide", first = "study", second = "stage", text = to_text(job);
  std::array<char*, 5> arguments{program.data(), first.data(), second.data(), text.data(), nullptr};
  ::execv("/proc/self/exe", arguments.data());
  throw FileError("the program cannot start itself (is /proc there?)");
}

}  // namespace

study::PoolOptions usual_pool_options() {
  study::PoolOptions options;
  options.jobs = options.threads = static_cast<std::size_t>(processors());
  constexpr double kShare = 0.9;
  options.memory = kShare * available_memory();
  options.costs = usual_cost_file();
  options.stop_requested = &stop_on_signal();
  options.body = become_stage;
  return options;
}

study::SessionRecord this_session(const study::PoolOptions& options) {
  return {.began = {},
          .program = program_version(),
          .processor = study::processor_name(),
          .processors = static_cast<std::size_t>(processors()),
          .jobs = options.jobs,
          .threads = options.threads};
}

study::PoolEvents logged(study::PoolEvents events, study::SessionLog& log) {
  events.ended = [tell = events.ended, &log](const study::StageEnd& end) {
    if (end.state == study::State::done && !end.found) log.stage_made();
    tell(end);
  };
  return events;
}

}  // namespace flowslide::cli
