#pragma once
#include "core/progress.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace flowslide {

struct HelperRun {
  std::vector<std::string> arguments;  ///< the program first: a path, or a name for the PATH
  std::filesystem::path folder;        ///< where it starts
  std::filesystem::path log;           ///< what it writes to its output and error output
  double seconds = 0.0;                ///< after which it is ended
};

struct HelperOutcome {
  int status = 0;  ///< exit status, 128 + signal, or 127 if there is no such program
  bool timed_out = false;
};

/// Runs a program and waits for its end. It is alone in a process group, gets none of our open
/// files, and dies with us, on its time limit and on a request to stop, together with what it has
/// started. Only absolute parts of the PATH are looked into.
/// Throws Interrupted, FileError if the system has no memory or process left.
HelperOutcome run_helper(const HelperRun& run, const Progress& progress);

}  // namespace flowslide
