#include "motion/foreign.hpp"

#include "core/check.hpp"
#include "core/conventions.hpp"
#include "motion/measures.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace flowslide {
namespace {

/// A format is recognised if every text stands in one of its first lines.
struct Format {
  std::string_view name;
  std::array<std::string_view, 2> texts;  ///< in capitals
  std::string_view what;
};

constexpr std::string_view kColumns =
    "write time and acceleration as two columns, one row per value, and declare the unit";

constexpr std::array kFormats = {
    Format{"K-NET or KiK-net",
           {"SAMPLING FREQ(HZ)", "SCALE FACTOR"},
           "its numbers are counts, eight to a line, to be multiplied by the scale factor"},
    Format{"K-NET CSV",
           {"#ORIGIN_TIME", "#SAMPLING_FREQ"},
           "its first column is a date, followed by three components"},
    Format{"COSMOS",
           {"(FORMAT V", "VALUES FOLLOW"},
           "its values stand after headers of text, integers and reals"},
    Format{
        "SMC", {"*", "CORRECTED ACCELEROGRAM"}, "its values stand in fixed columns after a header"},
    Format{"CSMIP",
           {"CORRECTED ACCELEROGRAM", ""},
           "its values stand in fixed columns after headers of 25 to 100 lines"},
    Format{"COSMOS or CSMIP",
           {"INTEGER-HEADER", ""},
           "its values stand after headers of text, integers and reals"},
    Format{"ESM",
           {"SAMPLING_INTERVAL_S:", "UNITS:"},
           "its values are one column after a header of 64 lines"},
};

}  // namespace

void refuse_foreign_format(const RecordText& text) {
  constexpr std::size_t kHeaderLines = 80;
  std::vector<std::string> head;
  for (std::size_t i = 0; i < std::min(kHeaderLines, text.lines.size()); ++i)
    head.push_back(upper_case(text.lines[i]));
  const auto has = [&](std::string_view wanted) {
    if (wanted.empty()) return true;
    return std::any_of(head.begin(), head.end(), [&](const std::string& line) {
      return wanted == "*" ? trimmed(line) == wanted : line.find(wanted) != std::string::npos;
    });
  };
  for (const Format& f : kFormats)
    validate(!has(f.texts[0]) || !has(f.texts[1]),
             "{}: is a record in the format {} (which is not read: {}) {}", text.name, f.name,
             f.what, kColumns);
}

std::vector<std::string> implausible(const std::string& name, double peak, double step) {
  std::vector<std::string> odd;
  const std::string of = name.empty() ? "" : name + ": ";
  // A handful of records exceed 2 g, beside faults; below 0.0005 g nobody feels it.
  constexpr double kMost = 2.0 * kGravity, kLeast = 5e-4 * kGravity;
  if (peak > kMost)
    odd.push_back(fmt::format(
        "{}the peak is {:.3g} g. Hardly any record exceeds 2 g; is the unit of acceleration "
        "right?",
        of, peak / kGravity));
  if (peak < kLeast)
    odd.push_back(fmt::format(
        "{}the peak is {:.2g} g, which nobody would feel. Is the unit of acceleration right?", of,
        peak / kGravity));
  // Records have 0.001 to 0.02 s; in 0.1 s nothing is left above 5 Hz.
  if (is_set(step) && !(step >= 1e-4 && step <= 0.1))
    odd.push_back(fmt::format(
        "{}the time step is {:.3g} s, where records have 0.001 to 0.02 s. Is the unit of time "
        "right?",
        of, step));
  return odd;
}

std::string implausible_velocity(const std::string& name, const GroundMotion& motion) {
  // The ground of the Chi-Chi earthquake reached about 4 m/s beside the fault.
  constexpr double kMost = 5.0;
  const double peak = pgv(motion);
  if (peak <= kMost) return {};
  return fmt::format(
      "{}the velocity reaches {:.3g} m/s and ends at {:.3g} m/s. No record exceeds 5 m/s; does the "
      "acceleration have an offset (`baseline`), or another unit?",
      name.empty() ? "" : name + ": ", peak, std::abs(velocity(motion).back()));
}

}  // namespace flowslide
