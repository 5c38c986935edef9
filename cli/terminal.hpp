#pragma once
#include "workflows/engine/runner.hpp"

#include <chrono>
#include <cstddef>
#include <cstdio>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace flowslide::cli {

/// "0:07", "12:30", "3:05:00"
std::string clock_text(double seconds);

/// "7 s", "12:30", "0.3 s"; "90 MB", "1.2 GB"
std::string about_seconds(double seconds);
std::string about_bytes(double bytes);

/// What stages were expected to take, and took.
struct Expectation {
  double expected = 0.0, taken = 0.0;  ///< [s] of the stages of which something was expected
  double memory = 0.0;                 ///< largest expected [bytes]
  int unknown = 0;                     ///< stages of which nobody knew
  void add(const Cost& cost);
};

/// Columns of the terminal behind a file descriptor, else of COLUMNS, else 80; at least 20.
std::size_t terminal_columns(int file);

/// Prints a label, "note: ", and a text behind it, on a terminal broken at blanks into lines of its
/// width, those after the first indented by the label; elsewhere one line, for scripts. A word that
/// is longer than a line stays whole. Allocates nothing.
void print_wrapped(std::FILE* file, std::string_view label, std::string_view text);

/// As print_wrapped for a line of two columns, a name and what is said of it, with blanks before
/// each: the lines after the first begin where the second column does, or further left on a
/// narrow terminal. A hash that is longer than a line is cut.
void print_row(std::FILE* file, std::string_view line);
void print_row(std::FILE* file, std::string_view label, std::string_view text);

/// Cuts at a column, never inside a UTF-8 character.
std::string cut_to(std::string text, std::size_t columns);

/// "warning: ..." on stderr.
void print_warning(std::string_view text);

/// Shows a run on stdout: on a terminal a bar that is redrawn and lines that are cut to its width,
/// elsewhere a line at every tenth and all lines whole. Warnings go to stderr, each once.
class Display {
 public:
  explicit Display(bool terminal);
  [[nodiscard]] RunEvents events();
  void plan(std::string_view stage, const Decision& decision) const;
  /// Something about the run folder, in full, however long.
  void notice(std::string_view text);
  /// Ends a bar that is still on the line.
  void close();
  [[nodiscard]] std::size_t num_warnings() const { return warned_.size(); }
  /// Of the stages that ran.
  [[nodiscard]] const Expectation& expectation() const { return expectation_; }

 private:
  void warn(std::string_view stage, const std::vector<std::string>& warnings);
  void progress(std::string_view stage, Share share, std::string_view text);
  void done(std::string_view stage, double seconds);

  bool terminal_;
  std::size_t columns_;  ///< that a line may have
  std::set<std::string> warned_;
  Cost expected_;  ///< of the stage that runs
  Expectation expectation_;
  bool bar_on_line_ = false;
  std::chrono::steady_clock::time_point start_, drawn_;
  double first_fraction_ = -1.0;  ///< where this session began; negative before the first report
  int last_tenth_ = 0;
};

}  // namespace flowslide::cli
