#pragma once
#include <atomic>
#include <filesystem>
#include <string>
#include <vector>

/// Pages of runs inside the page of a study, so that one file can be sent.
namespace flowslide::study {

struct EmbeddedRuns {
  std::string elements;  ///< one per page, and what they have in common; scripts/embedded.js reads
  std::vector<std::string> scripts, styles;  ///< source expressions for the policy of the page
  std::size_t states = 0;                    ///< of the player that has most
  std::size_t all_states = 0;                ///< that it has on its own page
};

/// Puts the page of each row, a path relative to the folder, into an element; the path becomes the
/// id of that. Rows that share a page share the element. What a page has of its own, but for its
/// numbers, is packed; style and script are there once for all pages of one program. A player
/// gets at most `states` states; 0: all that its page has. Throws FileError, and InputError for a
/// page that is damaged, Interrupted when it is to stop.
EmbeddedRuns embed_runs(const std::filesystem::path& folder, std::vector<std::string>& reports,
                        std::size_t states = 0, const std::atomic<bool>* stop = nullptr);

}  // namespace flowslide::study
