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
  // A terminal that closes may say so twice, and nohup asks not to hear of it.
  struct sigaction before {};
  sigaction(SIGHUP, nullptr, &before);
  action.sa_flags = SA_RESTART;
  if (before.sa_handler != SIG_IGN) sigaction(SIGHUP, &action, nullptr);
  // Whoever reads the output has gone: the next write says so, and what was begun is put in order.
  ::signal(SIGPIPE, SIG_IGN);
  return stop;
}

void refuse_by_return() { ::signal(SIGXFSZ, SIG_IGN); }

}  // namespace flowslide::cli
