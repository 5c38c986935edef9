#pragma once
#include "core/clock.hpp"

#include <cstdint>
#include <optional>
#include <vector>

/// How many threads a long run uses. Where another program holds the core of one thread, the others
/// wait for it in every sweep, and fewer threads are faster. docs/adr/0007-openmp-waits.md
namespace flowslide {

/// Finds the fastest number of threads among `most`, its half, its quarter ... and 1 by trying,
/// when it is told that threads are disturbed. Knows neither clocks nor threads.
class ThreadChoice {
 public:
  explicit ThreadChoice(int most);

  /// After a batch of work with threads(), done at `rate` [any unit per second]; `disturbed`: other
  /// programs took cores from it.
  void look(double rate, bool disturbed);

  [[nodiscard]] int threads() const { return counts_[trial_ ? *trial_ : used_]; }

 private:
  void end_trial(double rate);

  std::vector<int> counts_;  ///< descending
  std::size_t used_ = 0;     ///< into counts_
  std::optional<std::size_t> trial_;
  double rate_ = 0.0;         ///< of used_, in the batch before
  bool tried_fewer_ = false;  ///< in the last trial; the next tries more, if there are
  int wait_ = 0;              ///< batches until the next trial
  int pause_;                 ///< batches after a trial that gained nothing
};

/// ThreadChoice with a clock and what the system says of this process.
class ThreadPace {
 public:
  explicit ThreadPace(int most);
  /// To be called after every step; the number of threads for the next.
  int after_step();
  /// What is done between steps (files, reports) is no work of the threads.
  void leave_out_until_now();

 private:
  ThreadChoice choice_;
  bool alone_;  ///< one thread: nothing to choose
  Clock::time_point begin_ = Clock::now();
  std::int64_t steps_ = 0, switches_ = 0;
};

}  // namespace flowslide
