#include "core/thread_pace.hpp"

#include <algorithm>
#include <sys/resource.h>

namespace flowslide {
namespace {

constexpr double kBatchSeconds = 0.1;
constexpr double kGain = 1.1;  ///< a trial must be faster by this to be kept; batches scatter
/// Batches between trials: the first, doubled by each trial in vain up to the last, so that trials
/// of three times slower counts cost at most a few per cent.
constexpr int kFirstPause = 5, kLongestPause = 80;
/// Times in a batch that a thread had to leave its core: two threads on two cores 2 on a quiet
/// machine and 60 to 90 beside a busy program (a runout of 34,000 points).
constexpr std::int64_t kDisturbed = 5;

std::int64_t involuntary_switches() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return usage.ru_nivcsw;
}

}  // namespace

ThreadChoice::ThreadChoice(int most) : pause_(kFirstPause) {
  for (int n = std::max(1, most); n >= 1; n /= 2) counts_.push_back(n);
}

void ThreadChoice::end_trial(double rate) {
  const bool better = rate > kGain * rate_;
  if (better) {
    used_ = *trial_;
    rate_ = rate;
  }
  trial_.reset();
  pause_ = better ? kFirstPause : std::min(2 * pause_, kLongestPause);
  wait_ = pause_;
}

void ThreadChoice::look(double rate, bool disturbed) {
  if (trial_) return end_trial(rate);
  rate_ = rate;
  if (wait_ > 0) {
    --wait_;
    return;
  }
  const bool can_fewer = used_ + 1 < counts_.size(), can_more = used_ > 0;
  if (disturbed && can_fewer && !(tried_fewer_ && can_more)) {
    trial_ = used_ + 1;
    tried_fewer_ = true;
  } else if (can_more) {
    trial_ = used_ - 1;
    tried_fewer_ = false;
  }
}

ThreadPace::ThreadPace(int most) : choice_(most), alone_(most <= 1) {
  if (!alone_) switches_ = involuntary_switches();
}

int ThreadPace::after_step() {
  if (alone_) return 1;
  ++steps_;
  const double seconds = seconds_since(begin_);
  if (seconds < kBatchSeconds) return choice_.threads();
  const std::int64_t switches = involuntary_switches();
  choice_.look(double(steps_) / seconds, switches - switches_ >= kDisturbed);
  leave_out_until_now();
  return choice_.threads();
}

void ThreadPace::leave_out_until_now() {
  if (alone_) return;
  steps_ = 0;
  switches_ = involuntary_switches();
  begin_ = Clock::now();
}

}  // namespace flowslide
