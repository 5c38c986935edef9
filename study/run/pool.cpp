#include "study/run/pool.hpp"

#include "core/clock.hpp"
#include "study/run/child.hpp"
#include "study/run/tidy.hpp"
#include "study/run/work_costs.hpp"
#include "workflows/engine/program_version.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <chrono>
#include <csignal>
#include <list>
#include <poll.h>
#include <sstream>
#include <string.h>
#include <sys/wait.h>

namespace flowslide::study {
namespace {

constexpr double kPatience =
    60.0;  ///< between a polite signal and the one that nobody survives [s]

struct Running {
  std::size_t node = 0;
  int threads = 1;
  Child child;
  Clock::time_point start = Clock::now();
  double fraction = 0.0;
  std::string text, end, damaged;
  Clock::time_point told = {};  ///< when it was told to stop
  bool too_long = false;
};

/// What a stage said of its failure, for the list of the study.
std::string message_of(const std::string& errors) {
  std::string text;
  std::istringstream in(errors);
  for (std::string line; std::getline(in, line);) {
    if (line.empty() || line.starts_with("warning: ") || line.starts_with("note: ")) continue;
    if (line.starts_with("error: ")) line.erase(0, 7);
    text += (text.empty() ? "" : "\n") + line;
  }
  return text;
}

Failure failure_of(int status, const Running& r, const std::string& errors, double limit) {
  Failure f{
      .code = 3, .text = message_of(errors), .program = program_version(), .permanent = false};
  if (r.too_long) {
    f.code = 3;
    f.text = fmt::format(
        "took longer than {:g} s (limits.stage_time) raise the limit: a stage with "
        "checkpoints goes on where it was stopped.",
        limit);
  } else if (WIFSIGNALED(status)) {
    const int number = WTERMSIG(status);
    f.code = 128 + number;
    f.text = fmt::format("ended by signal {} ({}){}{}", number, ::strsignal(number),
                         number == SIGKILL
                             ? ". Where nobody has killed it, the machine had no memory left: take "
                               "fewer --jobs."
                             : ", a defect of the program. Please report it with the study file.",
                         f.text.empty() ? "" : "\n" + f.text);
    f.permanent = number == SIGSEGV || number == SIGABRT || number == SIGBUS || number == SIGFPE ||
                  number == SIGILL;
  } else if (WEXITSTATUS(status) == 0) {
    f.code = 4;
    f.text = r.end == "damaged"
                 ? fmt::format("the files of {} were damaged each time they were read (the disk?)",
                               r.damaged)
                 : "ended well, but its result cannot be read back (the disk?)";
  } else {
    f.code = WEXITSTATUS(status);
    f.permanent = f.code == 2 || f.code == 3;
    if (f.text.empty()) f.text = fmt::format("ended with exit code {} and no message", f.code);
  }
  return f;
}

class Pool {
 public:
  Pool(const Plan& plan, const Store& store, StudyState& progress, const PoolOptions& options,
       const PoolEvents& events)
      : plan_(plan),
        store_(store),
        progress_(progress),
        options_(options),
        events_(events),
        locks_(store.folder()),
        tidier_(plan, store, locks_),
        costs_(plan, progress, options.costs,
               static_cast<int>(options.threads / std::max<std::size_t>(1, options.jobs))),
        damages_(plan.nodes.size(), 0),
        not_before_(plan.nodes.size()) {}
  ~Pool() { costs_.keep(); }
  Pool(const Pool&) = delete;
  Pool& operator=(const Pool&) = delete;

  PoolEnd run() {
    store_.sweep();
    tidier_.tidy(progress_);
    for (;;) {
      if (stop()) {
        tell_all();
        if (running_.empty())
          throw Interrupted("stopped; the same command continues where the stages were.");
      } else if (outdated_ && running_.empty()) {
        return PoolEnd::outdated;
      } else if (!outdated_) {
        launch();
      }
      if (running_.empty() && !is_work_left() && !may_still_come()) return PoolEnd::done;
      wait();
      for (auto r = running_.begin(); r != running_.end();) {
        listen(*r);
        int status = 0;
        if (!r->child.has_ended(status)) {
          watch(*r);
          ++r;
          continue;
        }
        listen(*r);
        finish(*r, status);
        r = running_.erase(r);
      }
      events_.tick(view());
    }
  }

 private:
  [[nodiscard]] bool stop() const {
    return options_.stop_requested && options_.stop_requested->load();
  }
  [[nodiscard]] const std::string& stage(std::size_t node) const {
    return plan_.nodes[node].stage.name;
  }
  /// Of ours, or asked for by one of ours because its files have gone.
  [[nodiscard]] bool is_wanted(std::size_t n) const {
    const NodeState& node = progress_.node(n);
    return (node.state == State::ready && (options_.only.empty() || options_.only[n])) ||
           (node.state == State::done && node.again);
  }
  [[nodiscard]] bool is_work_left() const {
    for (std::size_t n = 0; n < plan_.nodes.size(); ++n)
      if (is_wanted(n)) return true;
    return false;
  }

  /// Looks again for what ours wait for and others should have made.
  bool may_still_come() {
    bool waits = false;
    for (std::size_t n = 0; n < options_.only.size(); ++n)
      waits |= options_.only[n] && progress_.node(n).state == State::waiting;
    if (!waits) return false;
    if (idle_since_ == Clock::time_point{}) idle_since_ = Clock::now();
    if (seconds_since(idle_since_) > options_.patience) return false;
    for (std::size_t n = 0; n < options_.only.size(); ++n)
      if (!options_.only[n] && progress_.node(n).state == State::ready) (void)progress_.is_open(n);
    progress_.resolve();
    return true;
  }

  /// To be run now: later stages before earlier ones, so that rows are finished one by one.
  [[nodiscard]] std::vector<std::size_t> candidates() const {
    std::vector<std::size_t> result;
    for (std::size_t n = 0; n < plan_.nodes.size(); ++n)
      if (is_wanted(n) && Clock::now() >= not_before_[n]) result.push_back(n);
    std::stable_sort(result.begin(), result.end(), [&](std::size_t a, std::size_t b) {
      return plan_.nodes[a].before.size() > plan_.nodes[b].before.size();
    });
    return result;
  }

  /// Another process of the same study may have been faster.
  bool is_found(std::size_t n) {
    if (progress_.is_open(n)) return false;
    events_.ended({n, progress_.node(n).state, true, 0.0});
    progress_.resolve();
    return true;
  }

  /// Asks for the files of the inputs where they have gone; true if they are all there.
  bool inputs_here(std::size_t n) {
    bool here = true;
    for (const std::size_t from : plan_.nodes[n].reads()) {
      NodeState& node = progress_.node(from);
      if (store_.has_files(stage(from), node.key)) continue;
      here = false;
      if (node.state == State::done) node.again = true;
      if (node.state != State::failed) continue;
      progress_.node(n).state = State::blocked;
      progress_.node(n).blocker = from;
      progress_.resolve();
    }
    return here;
  }

  void launch() {
    bool changed = true;
    while (changed && running_.size() < options_.jobs) {
      changed = false;
      const std::vector<std::size_t> list = candidates();
      for (const std::size_t n : list) {
        if (running_.size() >= options_.jobs) return;
        if (!fits(n)) continue;
        if (locks_.is_taken(progress_.node(n).key)) {
          not_before_[n] = Clock::now() + std::chrono::milliseconds(500);
          continue;
        }
        if (is_found(n) || !inputs_here(n)) {
          changed = true;
          continue;
        }
        start(n, list.size());
      }
      // What was asked for again becomes a candidate only once.
      if (changed && list == candidates()) return;
    }
  }

  /// Alone it may always run: what does not fit then is for the stage itself to refuse.
  [[nodiscard]] bool fits(std::size_t n) const {
    double taken = costs_.memory(n);
    for (const Running& r : running_) taken += costs_.memory(r.node);
    return running_.empty() || taken <= options_.memory;
  }

  /// All threads to few stages, one to each of many.
  [[nodiscard]] int threads_for(std::size_t waiting) const {
    std::size_t used = 0;
    for (const Running& r : running_) used += static_cast<std::size_t>(r.threads);
    const std::size_t free = options_.threads > used ? options_.threads - used : 1;
    const std::size_t slots = options_.jobs - running_.size();
    return static_cast<int>(
        std::max<std::size_t>(1, free / std::max<std::size_t>(1, std::min(waiting, slots))));
  }

  void start(std::size_t n, std::size_t waiting) {
    const Row& row = plan_.rows[plan_.nodes[n].row];
    const Job job{.store = store_.folder(),
                  .workflow = row.workflow,
                  .overrides = row.overrides,
                  .stage = stage(n),
                  .key = progress_.node(n).key,
                  .threads = threads_for(waiting),
                  .final_state = plan_.keep != Keep::numbers,
                  .allowed_programs = options_.allowed_programs};
    running_.push_back({.node = n,
                        .threads = job.threads,
                        .child = Child([&] { return options_.body(job); }),
                        .text = {},
                        .end = {},
                        .damaged = {}});
    progress_.node(n).state = State::running;
    idle_since_ = {};
  }

  void wait() {
    std::vector<pollfd> files;
    for (const Running& r : running_) {
      files.push_back({r.child.output(), POLLIN, 0});
      files.push_back({r.child.errors(), POLLIN, 0});
    }
    constexpr int kMilliseconds = 100;
    (void)::poll(files.data(), files.size(), kMilliseconds);
    // A pipe whose writer has gone is always ready: give the process time to end.
    if (std::any_of(files.begin(), files.end(),
                    [](const pollfd& f) { return f.revents & POLLHUP; }))
      (void)::poll(nullptr, 0, 2);
  }

  void listen(Running& r) {
    (void)r.child.read_errors();
    std::istringstream lines(r.child.read_output());
    for (std::string line; std::getline(lines, line);) {
      if (line == "made" || line == "found" || line == "busy" || line == "changed") r.end = line;
      if (line.starts_with("damaged ")) {
        r.end = "damaged";
        r.damaged = line.substr(8);
      }
      if (!line.starts_with("progress ")) continue;
      double fraction = 0.0;
      const char* begin = line.data() + 9;
      const auto [end, error] = std::from_chars(begin, line.data() + line.size(), fraction);
      if (error != std::errc()) continue;
      r.fraction = std::clamp(fraction, 0.0, 1.0);
      const auto rest = static_cast<std::size_t>(end - line.data()) + 1;
      r.text = rest < line.size() ? line.substr(rest) : "";
    }
  }

  void watch(Running& r) {
    if (!r.too_long && seconds_since(r.start) > plan_.limits.stage_seconds) {
      r.too_long = true;
      r.told = Clock::now();
      r.child.signal(SIGTERM);
    }
    if (r.told != Clock::time_point{} && seconds_since(r.told) > kPatience) r.child.signal(SIGKILL);
  }

  void tell_all() {
    for (Running& r : running_) {
      if (r.told != Clock::time_point{}) continue;
      r.told = Clock::now();
      r.child.signal(SIGTERM);
    }
  }

  void finish(Running& r, int status) {
    NodeState& node = progress_.node(r.node);
    const double seconds = seconds_since(r.start);
    const bool well = WIFEXITED(status) && WEXITSTATUS(status) == 0;
    if (well && r.end == "busy") {
      node.state = node.finished ? State::done : State::ready;
      not_before_[r.node] = Clock::now() + std::chrono::milliseconds(500);
      return;
    }
    if (well && r.end == "changed") {
      outdated_ = true;
      node.state = node.finished ? State::done : State::ready;
      return;
    }
    if (well && r.end == "damaged" && make_again(r)) return;
    if (well && (r.end == "made" || r.end == "found")) {
      if (auto finished = store_.finished(stage(r.node), node.key)) {
        node.finished = std::move(finished);
        node.state = State::done;
        node.again = false;
        if (r.end == "made") costs_.learn(r.node, *node.finished, r.threads);
        events_.ended({r.node, State::done, r.end == "found", seconds});
        progress_.resolve();
        tidier_.made(progress_, r.node);
        tidier_.tidy(progress_);
        return;
      }
    }
    if (stop()) {
      node.state = node.finished ? State::done : State::ready;
      return;
    }
    fail(r, failure_of(status, r, r.child.read_errors(), plan_.limits.stage_seconds), seconds);
  }

  void fail(const Running& r, Failure failure, double seconds) {
    NodeState& node = progress_.node(r.node);
    if (!node.finished) store_.write(stage(r.node), node.key, failure);
    node.failure = std::move(failure);
    node.state = State::failed;
    node.again = false;
    events_.ended({r.node, State::failed, false, seconds});
    progress_.resolve();
  }

  /// Makes an input anew whose files are damaged, if that has not been tried too often.
  bool make_again(const Running& r) {
    for (const std::size_t from : plan_.nodes[r.node].reads()) {
      if (stage(from) != r.damaged) continue;
      constexpr int kMost = 2;
      if (++damages_[from] > kMost) return false;
      events_.notice(
          fmt::format("{}: its result was damaged or has gone; it is made again.", r.damaged));
      const std::string& key = progress_.node(from).key;
      if (locks_.take(key)) {
        store_.drop_files(stage(from), key);
        locks_.release(key);
      }
      progress_.node(r.node).state = progress_.node(r.node).finished ? State::done : State::ready;
      not_before_[r.node] = Clock::now() + std::chrono::milliseconds(100);
      return true;
    }
    return false;
  }

  [[nodiscard]] PoolView view() const {
    PoolView v;
    v.all = plan_.nodes.size();
    v.done = progress_.count(State::done);
    v.failed = progress_.count(State::failed);
    v.blocked = progress_.count(State::blocked);
    double left = 0.0;
    for (std::size_t n = 0; n < plan_.nodes.size(); ++n) {
      const State s = progress_.node(n).state;
      if (s == State::ready || s == State::waiting || progress_.node(n).again)
        left += costs_.seconds(n);
    }
    for (const Running& r : running_) {
      const double seconds = seconds_since(r.start), all = costs_.seconds(r.node);
      v.running.push_back({r.node, r.threads, r.fraction, seconds, r.text});
      left += r.fraction > 0.05 ? seconds * (1.0 / r.fraction - 1.0) : std::max(0.0, all - seconds);
    }
    v.seconds_left = left / static_cast<double>(std::max<std::size_t>(1, options_.jobs));
    return v;
  }

  const Plan& plan_;
  const Store& store_;
  StudyState& progress_;
  const PoolOptions& options_;
  const PoolEvents& events_;
  Locks locks_;
  Tidier tidier_;
  Clock::time_point idle_since_ = {};  ///< ours wait, and nothing runs
  bool outdated_ = false;              ///< a stage found its workflow to be another one
  WorkCosts costs_;
  std::list<Running> running_;
  std::vector<int> damages_;                   ///< how often a result was found damaged
  std::vector<Clock::time_point> not_before_;  ///< for those that another process has
};

}  // namespace

PoolEnd run_pool(const Plan& plan, const Store& store, StudyState& progress,
                 const PoolOptions& options, const PoolEvents& events) {
  progress.reopen(options.retry ? Retry::all : Retry::passing);
  return Pool(plan, store, progress, options, events).run();
}

}  // namespace flowslide::study
