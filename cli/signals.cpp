#include "cli/signals.hpp"

#include <csignal>

namespace flowslide::cli {
namespace {

std::atomic<bool> stop = false;
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler may only use such");

extern "C" void on_signal(int) { stop.store(true); }

}  // namespace

const std::atomic<bool>& stop_on_signal(Again again) {
  struct sigaction action {};
  action.sa_handler = on_signal;
  action.sa_flags = (again == Again::ends ? static_cast<int>(SA_RESETHAND) : 0) | SA_RESTART;
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
  return stop;
}

}  // namespace flowslide::cli
