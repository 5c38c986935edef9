#pragma once
#include "study/page/svg.hpp"
#include "study/statistics/summary.hpp"
#include "study/statistics/threshold.hpp"
#include "study/table/analysis.hpp"

#include <optional>
#include <string>
#include <vector>

namespace flowslide::study {

struct Dot {
  double x = 0.0, y = 0.0;
  double scatter = kUnset;  ///< deviation of its repeats; NaN for a single row
  std::size_t series = 0;
  std::string title;
};

struct ChartRamp {
  Ramp ramp;
  std::optional<std::size_t> series;  ///< absent: of all
};

struct ScatterChart {
  std::string x_label, y_label;
  std::vector<Dot> dots;
  std::vector<std::string> series;  ///< names, if there is more than one
  std::string series_label;
  double usual_scatter = kUnset;  ///< numerical scatter, drawn once as a bar
  std::vector<ChartRamp> ramps;
};
Svg draw(const ScatterChart& chart);

/// Share of rows above a value.
Svg draw_exceedance(const Exceedance& curve, double usual_scatter, const std::string& label);

/// Bars from the low to the high end of each input, the longest first.
Svg draw_tornado(std::vector<Swing> swings, double usual_scatter, const std::string& label);

/// About n round numbers that lie in the range.
std::vector<double> round_numbers(double low, double high, int n);

}  // namespace flowslide::study
