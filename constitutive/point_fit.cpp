#include "constitutive/point_fit.hpp"

#include "core/check.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <optional>
#include <string>

#include <fmt/format.h>

namespace flowslide {
namespace {

constexpr int kDoublings = 10;
constexpr double kWithin = 1e-3;  ///< relative width of the bracket at the end

/// Cycles as a function of a parameter, counted; nothing where the parameter is refused.
class Trials {
 public:
  Trials(double target, const std::function<double(double)>& cycles)
      : target_(target), cycles_(cycles) {}
  double cycles(double value) {
    ++count_;
    const double n = cycles_(value);
    low_ = std::min(low_, value);
    high_ = std::max(high_, value);
    least_ = std::min(least_, n);
    most_ = std::max(most_, n);
    return n;
  }
  bool reaches(double value) { return cycles(value) >= target_; }
  std::optional<bool> reaches_if_allowed(double value) {
    try {
      return reaches(value);
    } catch (const InputError&) {
      return std::nullopt;
    } catch (const NumericsError&) {
      return std::nullopt;
    }
  }
  [[nodiscard]] int count() const { return count_; }
  /// The values tried, and what came of them.
  [[nodiscard]] std::string told() const {
    const std::string range = fmt::format("from {:.4g} to {:.4g} the strain is", low_, high_);
    if (std::isinf(least_)) return range + " not reached";
    if (least_ == most_) return fmt::format("{} reached after {:g} cycles", range, least_);
    if (std::isinf(most_))
      return fmt::format("{} reached after {:g} cycles or more", range, least_);
    return fmt::format("{} reached after {:g} to {:g} cycles", range, least_, most_);
  }

 private:
  double target_;
  const std::function<double(double)>& cycles_;
  int count_ = 0;
  double low_ = std::numeric_limits<double>::infinity(), high_ = 0.0;
  double least_ = low_, most_ = 0.0;
};

/// Four digits.
double rounded(double value) { return std::strtod(fmt::format("{:.3e}", value).c_str(), nullptr); }

struct Bracket {
  double above, below;  ///< values with which the target is reached, and is not
};

std::optional<Bracket> find_bracket(double start, Trials& trials) {
  const bool reached = trials.reaches(start);
  double last[2]{start, start};
  bool open[2]{true, true};
  for (int k = 0; k < kDoublings; ++k)
    for (const int side : {0, 1}) {
      if (!open[side]) continue;
      const double next = last[side] * (side == 0 ? 2.0 : 0.5);
      const std::optional<bool> there = trials.reaches_if_allowed(next);
      if (!there)
        open[side] = false;
      else if (*there != reached)
        return reached ? Bracket{last[side], next} : Bracket{next, last[side]};
      last[side] = next;
    }
  return std::nullopt;
}

}  // namespace

PointFit fit_to_cycles(double start, double target, const std::function<double(double)>& cycles) {
  Trials trials(target, cycles);
  const std::optional<Bracket> found = find_bracket(start, trials);
  if (!found)
    throw InputError(fmt::format(
        "{}, whatever the value ({:g} cycles were asked for, and this parameter does not decide). "
        "Is the stress ratio right, and is it this parameter that is to be found?",
        trials.told(), target));
  Bracket b = *found;
  while (std::abs(b.above / b.below - 1.0) > kWithin) {
    const double middle = std::sqrt(b.above * b.below);
    (trials.reaches(middle) ? b.above : b.below) = middle;
  }
  // the nearest four digits on the side where the target is reached
  double value = rounded(b.above);
  const bool rises = b.above > b.below;
  for (double away = 5e-4; (rises ? value < b.above : value > b.above); away += 5e-4)
    value = rounded(b.above * (rises ? 1.0 + away : 1.0 - away));
  const double with_it = trials.cycles(value);
  return {value, with_it, trials.count()};
}

}  // namespace flowslide
