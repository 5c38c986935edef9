#pragma once
#include "workflows/engine/runner.hpp"

#include <chrono>
#include <string>
#include <string_view>

namespace flowslide::cli {

/// "0:07", "12:30", "3:05:00"
std::string clock_text(double seconds);

/// Shows a run on stdout: a bar that is redrawn on a terminal, a line at every tenth elsewhere.
/// No line is longer than 80 columns.
class Display {
 public:
  explicit Display(bool terminal) : terminal_(terminal) {}
  [[nodiscard]] RunEvents events();
  void plan(std::string_view stage, const Decision& decision) const;
  /// Something about the run folder, in full, however long.
  void notice(std::string_view text);
  /// Ends a bar that is still on the line.
  void close();

 private:
  void progress(std::string_view stage, double fraction, std::string_view text);
  void done(std::string_view stage, double seconds);

  bool terminal_;
  bool bar_on_line_ = false;
  std::chrono::steady_clock::time_point start_, drawn_;
  double first_fraction_ = -1.0;  ///< where this session began; negative before the first report
  int last_tenth_ = 0;
};

}  // namespace flowslide::cli
