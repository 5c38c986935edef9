#include "study/page/chart.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <fmt/format.h>

namespace flowslide::study {
namespace {

constexpr double kWidth = 520.0, kHeight = 340.0;
constexpr double kLeft = 62.0, kRight = 16.0, kTop = 30.0, kBottom = 48.0;
constexpr std::size_t kColours = 6;

/// Values that differ by rounding alone are one value.
bool apart(double low, double high) {
  return high - low > 1e-9 * std::max(std::abs(low), std::abs(high));
}

std::string series_class(std::size_t series) { return fmt::format("s{}", series % kColours); }

/// Room on either side of one value.
double beside(double value) { return std::max(0.05 * std::abs(value), 1.0); }

/// Lower end of an axis: of one value that may be no less than 0, as a runout, not below it.
double lower_end(double low, double high, double room) {
  return low >= 0.0 && !apart(low, high) ? std::max(0.0, low - room) : low - room;
}

/// A label that leaves room for the bars beside it; their titles have all of it.
std::string short_label(const std::string& text) {
  constexpr std::size_t kMost = 18;
  if (text.size() <= kMost) return text;
  std::size_t end = kMost - 1;
  while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xc0) == 0x80) --end;
  return text.substr(0, end) + "…";
}

/// About, in pixels.
double width_of(const std::string& label) {
  return 8.0 + 6.5 * static_cast<double>(short_label(label).size());
}

/// Room for a plot with its axes.
class Frame {
 public:
  Frame(double x0, double x1, double y0, double y1) : x0_(x0), x1_(x1), y0_(y0), y1_(y1) {
    const double dx = apart(x0, x1) ? 0.04 * (x1 - x0) : beside(x0);
    const double dy = apart(y0, y1) ? 0.06 * (y1 - y0) : beside(y0);
    x0_ = lower_end(x0, x1, dx);
    x1_ += dx;
    y0_ = lower_end(y0, y1, dy);
    y1_ += dy;
  }
  [[nodiscard]] double x(double v) const {
    return kLeft + (v - x0_) / (x1_ - x0_) * (kWidth - kLeft - kRight);
  }
  [[nodiscard]] double y(double v) const {
    return kHeight - kBottom - (v - y0_) / (y1_ - y0_) * (kHeight - kTop - kBottom);
  }
  void axes(Svg& svg, const std::string& x_label, const std::string& y_label) const {
    for (const double v : round_numbers(x0_, x1_, 6)) {
      svg.line(x(v), kTop, x(v), kHeight - kBottom, "grid");
      svg.text(x(v), kHeight - kBottom + 16.0, fmt::format("{:g}", v));
    }
    for (const double v : round_numbers(y0_, y1_, 6)) {
      svg.line(kLeft, y(v), kWidth - kRight, y(v), "grid");
      svg.text(kLeft - 6.0, y(v) + 4.0, fmt::format("{:g}", v), "end");
    }
    svg.line(kLeft, kHeight - kBottom, kWidth - kRight, kHeight - kBottom, "axis");
    svg.line(kLeft, kTop, kLeft, kHeight - kBottom, "axis");
    svg.text(0.5 * (kLeft + kWidth - kRight), kHeight - 10.0, x_label, "middle", "head");
    svg.text(16.0, 0.5 * (kTop + kHeight - kBottom), y_label, "middle", "head", true);
  }

 private:
  double x0_, x1_, y0_, y1_;
};

std::string corner(const Frame& frame, double x, double y) {
  return fmt::format("{},{} ", pixels(frame.x(x)), pixels(frame.y(y)));
}

void draw_legend(Svg& svg, const ScatterChart& chart) {
  if (chart.series.size() < 2) return;
  double at = kLeft;
  svg.text(at, 18.0, chart.series_label, "start", "head");
  at += 14.0 + 7.0 * static_cast<double>(chart.series_label.size());
  for (std::size_t i = 0; i < chart.series.size(); ++i) {
    svg.circle(at, 14.0, 4.0, series_class(i));
    svg.text(at + 8.0, 18.0, chart.series[i], "start");
    at += 26.0 + 7.0 * static_cast<double>(chart.series[i].size());
  }
}

}  // namespace

std::vector<double> round_numbers(double low, double high, int n) {
  std::vector<double> numbers;
  if (!apart(low, high) || !std::isfinite(high - low)) return numbers;
  // Powers of ten by division: the library's pow may differ in its last bit.
  double unit = 1.0;
  const double wanted = (high - low) / n;
  while (unit > wanted) unit /= 10.0;
  while (unit * 10.0 <= wanted) unit *= 10.0;
  const double ratio = wanted / unit;
  const double step = unit * (ratio <= 1.0 ? 1.0 : ratio <= 2.0 ? 2.0 : ratio <= 5.0 ? 5.0 : 10.0);
  for (double i = std::ceil(low / step); i * step <= high; i += 1.0)
    numbers.push_back(i * step + 0.0);
  return numbers;
}

namespace {

/// Draws the numerical scatter at the right edge, at that height where the fewest dots are.
void draw_scatter(Svg& svg, const Frame& frame, const ScatterChart& chart) {
  constexpr double kWords = 150.0;  ///< width of bar and words
  const double x = kWidth - kRight - 8.0;
  const double half = std::abs(frame.y(0.0) - frame.y(chart.usual_scatter));
  const double margin = std::min(half, 30.0) + 10.0;
  double middle = 0.0;
  std::ptrdiff_t fewest = std::numeric_limits<std::ptrdiff_t>::max();
  for (const double share : {0.0, 1.0, 0.5, 0.25, 0.75}) {
    const double y = kTop + margin + share * (kHeight - kBottom - kTop - 2.0 * margin);
    const auto near = std::count_if(chart.dots.begin(), chart.dots.end(), [&](const Dot& d) {
      return frame.x(d.x) > x - kWords && std::abs(frame.y(d.y) - y) < margin;
    });
    if (near >= fewest) continue;
    fewest = near;
    middle = y;
  }
  svg.line(x, middle - half, x, middle + half, "bar");
  svg.line(x - 4.0, middle - half, x + 4.0, middle - half, "bar");
  svg.line(x - 4.0, middle + half, x + 4.0, middle + half, "bar");
  svg.text(x - 8.0, middle + 4.0, "numerical scatter", "end");
}

}  // namespace

Svg draw(const ScatterChart& chart) {
  double x0 = HUGE_VAL, x1 = -HUGE_VAL, y0 = 0.0, y1 = -HUGE_VAL;
  for (const Dot& d : chart.dots) {
    const double bar = is_set(d.scatter) ? d.scatter : 0.0;
    x0 = std::min(x0, d.x);
    x1 = std::max(x1, d.x);
    y0 = std::min(y0, d.y - bar);
    y1 = std::max(y1, d.y + bar);
  }
  Svg svg(kWidth, kHeight);
  if (chart.dots.empty()) return svg;
  const Frame frame(x0, x1, y0, y1);
  frame.axes(svg, chart.x_label, chart.y_label);
  for (const Dot& d : chart.dots)
    if (is_set(d.scatter))
      svg.line(frame.x(d.x), frame.y(d.y - d.scatter), frame.x(d.x), frame.y(d.y + d.scatter),
               "bar");
  for (const Dot& d : chart.dots)
    svg.circle(frame.x(d.x), frame.y(d.y), 4.5, series_class(d.series), d.title);
  for (const auto& [r, series] : chart.ramps) {
    // what the rows do not show is not drawn
    const bool begins = r.begins(), ends = r.ends();
    if (!is_set(r.breach.value) || (!begins && !ends)) continue;
    svg.polyline((begins ? corner(frame, x0, 0.0) : "") + corner(frame, r.breach.value, 0.0) +
                     corner(frame, r.saturation.value, r.plateau.value) +
                     (ends ? corner(frame, x1, r.plateau.value) : ""),
                 series ? fmt::format("fit f{}", *series % kColours) : "fit");
  }
  if (is_set(chart.usual_scatter)) draw_scatter(svg, frame, chart);
  draw_legend(svg, chart);
  return svg;
}

Svg draw_exceedance(const Exceedance& curve, double usual_scatter, const std::string& label) {
  Svg svg(kWidth, kHeight);
  if (curve.value.size() < 2) return svg;
  const Frame frame(std::min(0.0, curve.value.front()), curve.value.back(), 0.0, 1.0);
  frame.axes(svg, label, "share of rows above");
  std::string above, below, line;
  for (std::size_t i = 0; i < curve.value.size(); ++i) {
    const double before = i == 0 ? 1.0 : curve.share[i - 1];
    const auto step = [&](double shift) {
      return corner(frame, curve.value[i], std::clamp(before + shift, 0.0, 1.0)) +
             corner(frame, curve.value[i], std::clamp(curve.share[i] + shift, 0.0, 1.0));
    };
    above += step(curve.band);
    below = corner(frame, curve.value[i], std::clamp(curve.share[i] - curve.band, 0.0, 1.0)) +
            corner(frame, curve.value[i], std::clamp(before - curve.band, 0.0, 1.0)) + below;
    line += step(0.0);
  }
  svg.polygon(above + below, "band");
  svg.polyline(line, "curve");
  if (is_set(usual_scatter)) {
    const double length = frame.x(usual_scatter) - frame.x(0.0);
    svg.line(kLeft, 14.0, kLeft + length, 14.0, "fit");
    svg.text(kLeft + length + 6.0, 18.0, "numerical scatter", "start");
  }
  return svg;
}

Svg draw_tornado(std::vector<Swing> swings, double usual_scatter, const std::string& label) {
  std::sort(swings.begin(), swings.end(), [](const Swing& a, const Swing& b) {
    const double x = std::abs(a.effect.swing.value), y = std::abs(b.effect.swing.value);
    return x != y ? x > y : a.input < b.input;
  });
  constexpr double kRow = 46.0, kNames = 130.0;
  const double height = 74.0 + kRow * static_cast<double>(swings.size());
  Svg svg(kWidth, height);
  if (swings.empty()) return svg;
  double low = HUGE_VAL, high = -HUGE_VAL;
  for (const Swing& s : swings) {
    low = std::min({low, s.effect.low, s.effect.high});
    high = std::max({high, s.effect.low, s.effect.high});
  }
  const double room = apart(low, high) ? 0.02 * (high - low) : beside(low);
  low = lower_end(low, high, room);
  high += room;
  // words stand outside the bars
  double left = 0.0, right = 0.0;
  for (const Swing& s : swings) {
    const bool rises = s.effect.low < s.effect.high;
    left = std::max(left, width_of(rises ? s.effect.low_label : s.effect.high_label));
    right = std::max(right, width_of(rises ? s.effect.high_label : s.effect.low_label));
  }
  const double width = kWidth - kNames - 20.0 - left - right;
  const auto x = [&](double v) { return kNames + left + (v - low) / (high - low) * width; };
  const double bottom = height - 44.0;
  for (const double v : round_numbers(low, high, 6)) {
    svg.line(x(v), 14.0, x(v), bottom, "grid");
    svg.text(x(v), bottom + 16.0, fmt::format("{:g}", v));
  }
  svg.line(kNames, bottom, kWidth - 20.0, bottom, "axis");
  svg.text(0.5 * (kNames + kWidth), height - 10.0, label, "middle", "head");
  double y = 24.0;
  for (const Swing& s : swings) {
    const double a = x(s.effect.low), b = x(s.effect.high), middle = 0.5 * (a + b);
    const double to_low = std::min(a, middle), to_high = std::min(b, middle);
    svg.text(kNames - 10.0, y + 13.0, short_label(s.input), "end", "head");
    svg.rectangle(to_low, y, std::abs(middle - a), 18.0, "low", s.effect.low_label);
    svg.rectangle(to_high, y, std::abs(b - middle), 18.0, "high", s.effect.high_label);
    svg.text(a, y + 32.0, short_label(s.effect.low_label), a < b ? "end" : "start");
    svg.text(b, y + 32.0, short_label(s.effect.high_label), a < b ? "start" : "end");
    y += kRow;
  }
  if (is_set(usual_scatter)) {
    const double length = usual_scatter / (high - low) * width;
    svg.line(kNames, 12.0, kNames + length, 12.0, "fit");
    svg.text(kNames + length + 6.0, 15.0, "numerical scatter", "start");
  }
  return svg;
}

}  // namespace flowslide::study
