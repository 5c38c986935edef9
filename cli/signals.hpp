#pragma once
#include <atomic>

namespace flowslide::cli {

/// What a second SIGINT or SIGTERM does. A stage of a study may hear of one end from its study and
/// from Slurm.
enum class Again { ends, ignored };

/// Set by the first SIGINT or SIGTERM; the second one ends the program at once.
const std::atomic<bool>& stop_on_signal(Again again = Again::ends);

}  // namespace flowslide::cli
