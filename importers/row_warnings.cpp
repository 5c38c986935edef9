#include "importers/row_warnings.hpp"

#include "core/median.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include <fmt/format.h>

namespace flowslide {
namespace {

double usual_step(std::span<const double> times) {
  std::vector<double> steps;
  for (std::size_t i = 1; i < times.size(); ++i)
    if (times[i] > times[i - 1]) steps.push_back(times[i] - times[i - 1]);
  return steps.empty() ? 0.0 : median(std::move(steps));
}

/// Recorders that end a row of their own or more before the last.
void warn_of_ends(std::span<const FileTimes> files, std::vector<std::string>& warnings) {
  double latest = -std::numeric_limits<double>::infinity();
  for (const FileTimes& f : files) latest = std::max(latest, f.times.back());
  for (const FileTimes& f : files)
    if (latest - f.times.back() > 0.99 * step_range(f.times).max)
      warnings.push_back(fmt::format(
          "{} ends at {:.6g} s, others at {:.6g} s: what comes later is not used. Was the run "
          "stopped before the recorder was written out (`wipe`)?",
          f.file, f.times.back(), latest));
}

/// Rows that the recorder `f` lacks between two of its own, while one that records as often has
/// them. A recorder that was thinned by -dT has a longer step everywhere, and lacks none.
bool warn_of_gap(std::span<const FileTimes> files, const FileTimes& f,
                 std::vector<std::string>& warnings) {
  const double step = usual_step(f.times);
  const auto as_often = [&](const FileTimes& g) {
    return &g != &f && usual_step(g.times) < 1.01 * step && usual_step(g.times) > 0.99 * step;
  };
  const auto other = std::ranges::find_if(files, as_often);
  if (other == files.end()) return false;
  for (std::size_t i = 1; i < f.times.size(); ++i) {
    const double from = f.times[i - 1], to = f.times[i];
    const auto inside = std::ranges::count_if(
        other->times, [&](double t) { return t > from + 0.5 * step && t < to - 0.5 * step; });
    if (inside == 0) continue;
    warnings.push_back(
        fmt::format("{} has no row between {:.6g} and {:.6g} s, where {} has {}: those are not "
                    "used. Was the file damaged, or put together from two runs?",
                    f.file, from, to, other->file, inside));
    return true;
  }
  return false;
}

/// Rows thinned by -dT are none of the others' business; rows that nothing fits are.
void warn_of_digits(std::span<const FileTimes> files, const AlignedRows& aligned,
                    std::vector<std::string>& warnings) {
  const auto common = [&](double t) {
    return t >= aligned.times.front() && t <= aligned.times.back();
  };
  std::size_t usable = std::numeric_limits<std::size_t>::max();
  for (const FileTimes& f : files)
    usable = std::min<std::size_t>(usable, std::ranges::count_if(f.times, common));
  if (usable > aligned.times.size())
    warnings.push_back(
        fmt::format("{} of the rows that every recorder has up to {:.6g} s are not used: their "
                    "times differ, or repeat (times with too few digits?). Record with a higher "
                    "-precision.",
                    usable - aligned.times.size(), aligned.times.back()));
}

/// Shakings last from seconds to minutes, and water drains for hours after.
void warn_of_unit(std::span<const double> times, std::vector<std::string>& warnings) {
  constexpr double kShortest = 0.3, kLongest = 86400.0;  // [s]
  constexpr std::size_t kFew = 3;
  const double lasts = times.back() - times.front();
  if (times.size() >= kFew && !(lasts >= kShortest && lasts <= kLongest))
    warnings.push_back(fmt::format("the shaking lasts {:.3g} s. Is `units.time` right?", lasts));
}

}  // namespace

std::vector<std::string> row_warnings(std::span<const FileTimes> files,
                                      const AlignedRows& aligned) {
  std::vector<std::string> warnings;
  warn_of_unit(aligned.times, warnings);
  // With stages, the choice of one is said by a note.
  for (const FileTimes& f : files)
    if (split_stages(f.times).size() > 1) return warnings;
  warn_of_ends(files, warnings);
  bool lost = false;
  for (const FileTimes& f : files) lost = warn_of_gap(files, f, warnings) || lost;
  if (!lost) warn_of_digits(files, aligned, warnings);
  return warnings;
}

}  // namespace flowslide
