#pragma once
#include <atomic>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace flowslide::study {

struct CommandEnd {
  int code = 0;  ///< 128 + n if signal n ended it
  std::string out, errors;
};

/// Runs a program of the PATH, without a shell between, in a folder, and waits for its end. Nothing
/// if there is no such program. Throws Interrupted if asked to stop, and
/// FileError after five minutes.
std::optional<CommandEnd> run_command(const std::vector<std::string>& words,
                                      const std::filesystem::path& folder,
                                      const std::atomic<bool>* stop);

}  // namespace flowslide::study
