#include "importers/recorder_times.hpp"

#include "core/check.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace flowslide {
namespace {

std::string describe_stages(std::span<const double> times, std::span<const RowRange> stages) {
  std::string text;
  for (std::size_t s = 0; s < stages.size() && s < 5; ++s) {
    text += fmt::format("{}{} to {} in {} rows", s == 0 ? "" : ", ", times[stages[s].first],
                        times[stages[s].last - 1], stages[s].last - stages[s].first);
  }
  return stages.size() > 5 ? text + ", ..." : text;
}

RowRange choose_stage(const FileTimes& file, StageChoice choice, std::vector<std::string>& notes) {
  const std::vector<RowRange> stages = split_stages(file.times);
  validate(!stages.empty(), "{}: has no usable row", file.file);
  if (stages.size() == 1) return stages.front();
  const std::string text = describe_stages(file.times, stages);
  validate(choice != StageChoice::only,
           "{}: time goes back, {} stages (gravity and shaking in one file?): {}. Choose with "
           "`stage: first` or `stage: last`",
           file.file, stages.size(), text);
  const bool first = choice == StageChoice::first;
  notes.push_back(fmt::format("{}: {} stages ({}), the {} one is used", file.file, stages.size(),
                              text, first ? "first" : "last"));
  return first ? stages.front() : stages.back();
}

// Rows of a stage, of equal times only the last.
std::vector<std::size_t> distinct_rows(const FileTimes& file, RowRange stage,
                                       std::vector<std::string>& notes) {
  std::vector<std::size_t> rows;
  for (std::size_t r = stage.first; r < stage.last; ++r) {
    if (r + 1 < stage.last && file.times[r + 1] == file.times[r]) continue;
    rows.push_back(r);
  }
  const std::size_t dropped = stage.last - stage.first - rows.size();
  if (dropped > 0)
    notes.push_back(fmt::format("{}: {} rows repeat the time of the row after them, dropped",
                                file.file, dropped));
  return rows;
}

double smallest_step(const FileTimes& file, std::span<const std::size_t> rows) {
  double step = std::numeric_limits<double>::infinity();
  for (std::size_t i = 1; i < rows.size(); ++i)
    step = std::min(step, file.times[rows[i]] - file.times[rows[i - 1]]);
  return step;
}

}  // namespace

std::vector<RowRange> split_stages(std::span<const double> times) {
  std::vector<RowRange> stages;
  for (std::size_t i = 0; i < times.size(); ++i) {
    if (i == 0 || times[i] < times[i - 1]) stages.push_back({i, i});
    stages.back().last = i + 1;
  }
  return stages;
}

StepRange step_range(std::span<const double> times) {
  StepRange range{std::numeric_limits<double>::infinity(), 0.0};
  for (std::size_t i = 1; i < times.size(); ++i) {
    const double step = times[i] - times[i - 1];
    if (!(step > 0.0)) continue;
    range.min = std::min(range.min, step);
    range.max = std::max(range.max, step);
  }
  return range.max > 0.0 ? range : StepRange{};
}

AlignedRows align_rows(std::span<const FileTimes> files, StageChoice choice) {
  AlignedRows aligned;
  std::vector<std::vector<std::size_t>> rows;
  double step = std::numeric_limits<double>::infinity();
  for (const FileTimes& file : files) {
    rows.push_back(distinct_rows(file, choose_stage(file, choice, aligned.notes), aligned.notes));
    step = std::min(step, smallest_step(file, rows.back()));
  }

  aligned.rows.resize(files.size());
  std::vector<std::size_t> at(files.size(), 0);
  const auto time_of = [&](std::size_t f) { return files[f].times[rows[f][at[f]]]; };
  const auto any_at_end = [&] {
    for (std::size_t f = 0; f < files.size(); ++f)
      if (at[f] == rows[f].size()) return true;
    return false;
  };
  while (!any_at_end()) {
    double latest = time_of(0);
    for (std::size_t f = 1; f < files.size(); ++f) latest = std::max(latest, time_of(f));
    const double tolerance = std::min(1e-5 * std::abs(latest), 0.25 * step);
    bool all_equal = true;
    for (std::size_t f = 0; f < files.size(); ++f) {
      if (time_of(f) >= latest - tolerance) continue;
      ++at[f];
      all_equal = false;
    }
    if (!all_equal) continue;
    aligned.times.push_back(time_of(0));
    for (std::size_t f = 0; f < files.size(); ++f) aligned.rows[f].push_back(rows[f][at[f]++]);
  }

  if (aligned.times.empty()) {
    std::string ranges;
    for (std::size_t f = 0; f < files.size(); ++f)
      ranges += fmt::format("{}{} {} to {}", f == 0 ? "" : ", ", files[f].file,
                            files[f].times[rows[f].front()], files[f].times[rows[f].back()]);
    throw InputError(fmt::format(
        "the recorders have no time in common ({}) are they from the same run?", ranges));
  }
  for (std::size_t f = 0; f < files.size(); ++f) {
    const std::size_t unused = rows[f].size() - aligned.times.size();
    if (unused > 0)
      aligned.notes.push_back(
          fmt::format("{}: {} of {} rows are at times that another file lacks, not used",
                      files[f].file, unused, rows[f].size()));
  }
  return aligned;
}

}  // namespace flowslide
