#pragma once
#include "core/check.hpp"

#include <atomic>
#include <functional>
#include <string_view>

namespace flowslide {

/// Share of the work that is done, 0 to 1.
struct Share {
  double done = 0.0;
  bool at_least = false;  ///< the work may end before all of it is done
  Share(double share, bool open = false) : done(share), at_least(open) {}
  operator double() const { return done; }
};

/// What a long computation tells its caller, a few times a second at most.
struct Progress {
  /// How far it is, and one short line about its state.
  std::function<void(Share share, std::string_view text)> report = [](Share, std::string_view) {};
  /// Set by a signal handler: finish the step, write a checkpoint and throw Interrupted.
  const std::atomic<bool>* stop_requested = nullptr;
  [[nodiscard]] bool should_stop() const { return stop_requested && stop_requested->load(); }
  /// For the loops of stages that keep nothing when they are interrupted; costs a load.
  void poll() const {
    if (should_stop())
      throw Interrupted(
          "interrupted (this stage had not finished) the same command begins it again");
  }
};

}  // namespace flowslide
