#pragma once
#include <atomic>

namespace flowslide::cli {

/// What a second SIGINT or SIGTERM does. A stage of a study may hear of one end from its study and
/// from Slurm.
enum class Again { ends, ignored };

/// Set by the first SIGINT, SIGTERM or SIGHUP; a second of the first two ends the program at once.
/// A reader of the output that goes away is from here on an error of writing, not a signal.
const std::atomic<bool>& stop_on_signal(Again again = Again::ends);

/// A file beyond the size that the system allows (ulimit -f) is an error of its write, not a
/// signal.
void refuse_by_return();

}  // namespace flowslide::cli
