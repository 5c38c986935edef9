#include "cli/terminal.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdio>

#include <fmt/format.h>

namespace flowslide::cli {
namespace {

using Clock = std::chrono::steady_clock;
constexpr std::size_t kColumns = 79;  // one less than 80: some terminals wrap at the last column
constexpr int kNameWidth = 8;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// Cuts at a column, never inside a UTF-8 character.
std::string cut(std::string text) {
  if (text.size() <= kColumns) return text;
  std::size_t end = kColumns - 3;
  while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0) == 0x80) --end;
  return text.substr(0, end) + "...";
}

}  // namespace

std::string clock_text(double seconds) {
  const auto total = static_cast<long>(std::lround(std::clamp(seconds, 0.0, 3.6e7)));
  const long hours = total / 3600, minutes = total / 60 % 60, rest = total % 60;
  return hours > 0 ? fmt::format("{}:{:02}:{:02}", hours, minutes, rest)
                   : fmt::format("{}:{:02}", minutes, rest);
}

RunEvents Display::events() {
  RunEvents events;
  events.decided = [this](std::string_view stage, const Decision& decision) {
    plan(stage, decision);
    std::fflush(stdout);
    start_ = Clock::now();
    first_fraction_ = -1.0;
    last_tenth_ = 0;
  };
  events.progress = [this](std::string_view stage, double fraction, std::string_view text) {
    progress(stage, fraction, text);
  };
  events.done = [this](std::string_view stage, double seconds) { done(stage, seconds); };
  events.notice = [this](std::string_view text) { notice(text); };
  return events;
}

void Display::plan(std::string_view stage, const Decision& decision) const {
  const char* verb = decision.action == Action::reuse       ? ""
                     : decision.action == Action::undecided ? "may run: "
                                                            : "runs: ";
  fmt::print("{}\n", cut(fmt::format("{:<{}} {}{}", stage, kNameWidth, verb, decision.why)));
}

void Display::progress(std::string_view stage, double fraction, std::string_view text) {
  if (!(fraction >= 0.0 && fraction <= 1.0)) return;
  if (first_fraction_ < 0.0) {
    first_fraction_ = fraction;
    last_tenth_ = static_cast<int>(fraction * 10.0);
  }
  const double gained = fraction - first_fraction_;
  const std::string eta =
      gained > 1e-6 ? clock_text(seconds_since(start_) * (1.0 - fraction) / gained) : "?";
  const int percent = static_cast<int>(fraction * 100.0);
  if (!terminal_) {
    const int tenth = static_cast<int>(fraction * 10.0);
    if (tenth <= last_tenth_ || tenth == 10) return;
    last_tenth_ = tenth;
    fmt::print("{}\n", cut(fmt::format("{:<{}} {:>3} %  ETA {:>5}  {}", stage, kNameWidth, percent,
                                       eta, text)));
    std::fflush(stdout);
    return;
  }
  if (bar_on_line_ && seconds_since(drawn_) < 0.1) return;
  drawn_ = Clock::now();
  constexpr int kBar = 16;
  const int full = static_cast<int>(fraction * kBar);
  fmt::print("\r\033[K{}",
             cut(fmt::format("{:<{}} [{:#<{}}{:-<{}}] {:>3} %  ETA {:>5}  {}", stage, kNameWidth,
                             "", full, "", kBar - full, percent, eta, text)));
  std::fflush(stdout);
  bar_on_line_ = true;
}

void Display::done(std::string_view stage, double seconds) {
  if (bar_on_line_) fmt::print("\r\033[K");
  bar_on_line_ = false;
  fmt::print("{:<{}} done in {:.1f} s\n", stage, kNameWidth, seconds);
  std::fflush(stdout);
}

void Display::notice(std::string_view text) {
  close();
  std::string line(text);
  // Names come from files, which must not steer the terminal.
  std::replace_if(
      line.begin(), line.end(), [](unsigned char c) { return std::iscntrl(c); }, '?');
  fmt::print("note: {}\n", line);
}

void Display::close() {
  if (bar_on_line_) fmt::print("\n");
  bar_on_line_ = false;
  std::fflush(stdout);
}

}  // namespace flowslide::cli
