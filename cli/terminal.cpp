#include "cli/terminal.hpp"

#include "core/clock.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <sys/ioctl.h>
#include <unistd.h>

#include <fmt/format.h>

namespace flowslide::cli {
namespace {

constexpr int kNameWidth = 8;

bool continues(char c) { return (static_cast<unsigned char>(c) & 0xC0) == 0x80; }

/// Columns of a bar beside a text: a narrow terminal loses the bar before the state of the run.
int bar_width(std::size_t columns, std::size_t text) {
  constexpr std::size_t kAround = 4;  // brackets, a blank, a digit by which the text may grow
  for (const int bar : {16, 8, 4})
    if (text + kAround + static_cast<std::size_t>(bar) <= columns) return bar;
  return 0;
}

std::size_t width_of(std::string_view text) {
  return text.size() - static_cast<std::size_t>(std::count_if(text.begin(), text.end(), continues));
}

/// Columns in which lines are broken, 0 where they are not. One is kept free: some terminals wrap
/// at the last one.
std::size_t line_columns(std::FILE* file) {
  const int descriptor = ::fileno(file);
  return ::isatty(descriptor) == 1 ? terminal_columns(descriptor) - 1 : 0;
}

/// Text that a file brought must not steer the terminal.
void print_word(std::FILE* file, std::string_view word) {
  for (const char c : word)
    std::fputc(std::iscntrl(static_cast<unsigned char>(c)) && c != '\t' ? '?' : c, file);
}

bool is_hash(std::string_view word) {
  constexpr std::size_t kShortest = 32;
  return word.size() >= kShortest && std::all_of(word.begin(), word.end(), [](char c) {
           return std::isxdigit(static_cast<unsigned char>(c)) != 0;
         });
}

/// A label and words in lines of so many columns; lines after the first begin at `hang`.
void print_hanging(std::FILE* file, std::string_view label, std::size_t hang, std::string_view text,
                   std::size_t columns) {
  std::fwrite(label.data(), 1, label.size(), file);
  const std::size_t start = width_of(label);
  std::size_t column = start;
  while (!text.empty()) {
    const std::size_t blanks = std::min(text.find_first_not_of(' '), text.size());
    const std::string_view word = text.substr(blanks, text.find(' ', blanks) - blanks);
    const std::size_t width = width_of(word);
    const bool breaks =
        columns > 0 && column > std::max(start, hang) && column + blanks + width > columns;
    if (breaks) std::fputc('\n', file);
    const std::size_t gap = breaks ? hang : blanks;
    for (std::size_t i = 0; i < gap; ++i) std::fputc(' ', file);
    column = breaks ? gap : column + gap;
    if (columns > column + 8 && column + width > columns && is_hash(word)) {
      print_word(file, word.substr(0, columns - column - 3));
      std::fputs("...", file);
    } else {
      print_word(file, word);
    }
    column += width;
    text.remove_prefix(blanks + word.size());
  }
  std::fputc('\n', file);
}

}  // namespace

std::string cut_to(std::string text, std::size_t columns) {
  if (width_of(text) <= columns) return text;
  std::size_t end = 0;
  for (std::size_t column = 0; end < text.size(); ++end)
    if (!continues(text[end]) && ++column > columns - 3) break;
  return text.substr(0, end) + "...";
}

std::size_t terminal_columns(int file) {
  constexpr std::size_t kLeast = 20, kUsual = 80, kMost = 10000;
  winsize size{};
  if (::ioctl(file, TIOCGWINSZ, &size) == 0 && size.ws_col > 0)
    return std::max<std::size_t>(kLeast, size.ws_col);
  const char* variable = std::getenv("COLUMNS");
  const long columns = variable ? std::strtol(variable, nullptr, 10) : 0;
  return columns > 0 ? std::clamp<std::size_t>(static_cast<std::size_t>(columns), kLeast, kMost)
                     : kUsual;
}

void print_wrapped(std::FILE* file, std::string_view label, std::string_view text) {
  print_hanging(file, label, label.size(), text, line_columns(file));
}

void print_row(std::FILE* file, std::string_view label, std::string_view text) {
  constexpr std::size_t kLeast = 25;  // columns for the text
  const std::size_t columns = line_columns(file), hang = width_of(label);
  if (columns == 0 || hang + kLeast <= columns || hang + width_of(text) <= columns)
    return print_hanging(file, label, hang, text, columns);
  // The name has a line of its own.
  const std::size_t begin = std::min(label.find_first_not_of(' '), label.size());
  const std::size_t end = label.find_last_not_of(' ') + 1;
  if (begin < end) print_hanging(file, label.substr(0, end), 0, "", columns);
  constexpr std::string_view kIndent = "            ";
  const std::string_view indent =
      kIndent.substr(0, std::min(begin < end ? begin + 4 : 4, kIndent.size()));
  print_hanging(file, indent, indent.size(), text, columns);
}

void print_row(std::FILE* file, std::string_view line) {
  const std::size_t begin = std::min(line.find_first_not_of(' '), line.size());
  const std::size_t gap = line.find("  ", begin);
  const std::size_t second = gap == std::string_view::npos
                                 ? begin
                                 : std::min(line.find_first_not_of(' ', gap), line.size());
  print_row(file, line.substr(0, second), line.substr(second));
}

void print_warning(std::string_view text) {
  std::fflush(stdout);
  print_wrapped(stderr, "warning: ", text);
}

Display::Display(bool terminal)
    : terminal_(terminal),
      columns_(terminal ? terminal_columns(STDOUT_FILENO) - 1 : std::string::npos) {}

void Display::warn(std::string_view stage, const std::vector<std::string>& warnings) {
  for (const std::string& text : warnings) {
    std::string line = fmt::format("{}: {}", stage, text);
    if (warned_.count(line) > 0) continue;
    close();
    print_warning(line);
    warned_.insert(std::move(line));
  }
}

std::string clock_text(double seconds) {
  const auto total = static_cast<long>(std::lround(std::clamp(seconds, 0.0, 3.6e7)));
  const long hours = total / 3600, minutes = total / 60 % 60, rest = total % 60;
  return hours > 0 ? fmt::format("{}:{:02}:{:02}", hours, minutes, rest)
                   : fmt::format("{}:{:02}", minutes, rest);
}

std::string about_seconds(double seconds) {
  constexpr double kFew = 9.5, kClock = 99.5;
  return seconds < kFew     ? fmt::format("{:.1f} s", seconds)
         : seconds < kClock ? fmt::format("{:.0f} s", seconds)
                            : clock_text(seconds);
}

std::string about_bytes(double bytes) {
  constexpr double kMega = 1e6, kGiga = 1e9;
  return bytes < kGiga ? fmt::format("{:.0f} MB", bytes / kMega)
                       : fmt::format("{:.1f} GB", bytes / kGiga);
}

void Expectation::add(const Cost& cost) {
  if (is_set(cost.memory)) memory = std::max(memory, cost.memory);
  if (is_set(cost.seconds))
    expected += cost.seconds;
  else
    ++unknown;
}

RunEvents Display::events() {
  RunEvents events;
  events.decided = [this](std::string_view stage, const Decision& decision) {
    plan(stage, decision);
    expected_ = decision.expected;
    std::fflush(stdout);
    start_ = Clock::now();
    first_fraction_ = -1.0;
    last_tenth_ = 0;
  };
  events.progress = [this](std::string_view stage, Share share, std::string_view text) {
    progress(stage, share, text);
  };
  events.done = [this](std::string_view stage, double seconds) { done(stage, seconds); };
  events.notice = [this](std::string_view text) { notice(text); };
  events.warned = [this](std::string_view stage, const std::vector<std::string>& warnings) {
    warn(stage, warnings);
  };
  return events;
}

void Display::plan(std::string_view stage, const Decision& decision) const {
  const char* verb = decision.action == Action::reuse       ? ""
                     : decision.action == Action::undecided ? "may run: "
                                                            : "runs: ";
  std::string why = decision.why;
  const std::size_t n = decision.warnings.size();
  if (n > 0 && decision.action == Action::reuse) {
    const bool follow = std::any_of(decision.warnings.begin(), decision.warnings.end(),
                                    [&](const std::string& text) {
                                      return warned_.count(fmt::format("{}: {}", stage, text)) == 0;
                                    });
    why += fmt::format(", {} warning{}{}", n, n == 1 ? "" : "s", follow ? ":" : " (above)");
  }
  std::string cost;
  if (is_set(decision.expected.seconds))
    cost += ", about " + about_seconds(decision.expected.seconds);
  if (is_set(decision.expected.memory)) cost += ", " + about_bytes(decision.expected.memory);
  // Of a long reason the end goes, not what it takes; a narrow terminal has room for the reason
  // only.
  constexpr std::size_t kLeast = 50;
  if (cost.size() + kLeast > columns_) cost.clear();
  const std::string line = fmt::format("{:<{}} {}{}", stage, kNameWidth, verb, why);
  fmt::print("{}{}\n", cut_to(line, columns_ - cost.size()), cost);
}

void Display::progress(std::string_view stage, Share share, std::string_view text) {
  const double fraction = share.done;
  if (!(fraction >= 0.0 && fraction <= 1.0)) return;
  if (first_fraction_ < 0.0) {
    first_fraction_ = fraction;
    last_tenth_ = static_cast<int>(fraction * 10.0);
  }
  const double gained = fraction - first_fraction_;
  const std::string eta = gained > 1e-6
                              ? (share.at_least ? "<" : "") +
                                    clock_text(seconds_since(start_) * (1.0 - fraction) / gained)
                              : "?";
  const int percent = static_cast<int>(fraction * 100.0);
  if (!terminal_) {
    const int tenth = static_cast<int>(fraction * 10.0);
    if (tenth <= last_tenth_ || tenth == 10) return;
    last_tenth_ = tenth;
    fmt::print("{}\n", cut_to(fmt::format("{:<{}} {:>3} %  ETA {:>5}  {}", stage, kNameWidth,
                                          percent, eta, text),
                              columns_));
    std::fflush(stdout);
    return;
  }
  if (bar_on_line_ && seconds_since(drawn_) < 0.1) return;
  drawn_ = Clock::now();
  const std::string state = fmt::format("{:>3} %  ETA {:>5}  {}", percent, eta, text);
  const int bar = bar_width(columns_, kNameWidth + 1 + width_of(state));
  const int full = static_cast<int>(fraction * bar);
  const std::string drawn =
      bar > 0 ? fmt::format("[{:#<{}}{:-<{}}] ", "", full, "", bar - full) : "";
  fmt::print("\r\033[K{}",
             cut_to(fmt::format("{:<{}} {}{}", stage, kNameWidth, drawn, state), columns_));
  std::fflush(stdout);
  bar_on_line_ = true;
}

void Display::done(std::string_view stage, double seconds) {
  if (bar_on_line_) fmt::print("\r\033[K");
  bar_on_line_ = false;
  expectation_.add(expected_);
  if (is_set(expected_.seconds)) expectation_.taken += seconds;
  fmt::print("{:<{}} done in {:.1f} s\n", stage, kNameWidth, seconds);
  std::fflush(stdout);
}

void Display::notice(std::string_view text) {
  close();
  print_wrapped(stdout, "note: ", text);
}

void Display::close() {
  if (bar_on_line_) fmt::print("\n");
  bar_on_line_ = false;
  std::fflush(stdout);
}

}  // namespace flowslide::cli
