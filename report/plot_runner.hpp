#pragma once
#include "core/progress.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace flowslide {

struct FigureLimits {
  Progress progress;       ///< a request to stop ends the interpreter
  double seconds = 120.0;  ///< so does this time
  /// For messages: how an interpreter is named, and what to do when it is there.
  std::string_view named_by = "in the setting 'python'", again = "build the report again";
};

/// Writes the scripts that draw figures into an existing folder; returns their paths from the
/// folder above it.
std::vector<std::string> write_plot_scripts(const std::filesystem::path& folder);

/// Calls MODULE.FUNCTION, say "plot.run", of the scripts inside this program with texts as
/// arguments, in an isolated interpreter. `python` is the interpreter; if empty, the first of
/// `python3` on the PATH and /usr/bin/python3 that has matplotlib. Returns why nothing was drawn
/// and what to do; empty if it was. Throws FileError if disk or memory do not suffice, Interrupted
/// on a request.
std::string run_plot_script(const std::string& function, const std::vector<std::string>& arguments,
                            const std::optional<std::string>& python, const FigureLimits& limits);

}  // namespace flowslide
