#pragma once
#include <atomic>

namespace flowslide::cli {

/// Set by the first SIGINT or SIGTERM; the second one ends the program at once.
const std::atomic<bool>& stop_on_signal();

}  // namespace flowslide::cli
