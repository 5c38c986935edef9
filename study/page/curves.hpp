#pragma once
#include "report/page_arrays.hpp"
#include "report/page_read.hpp"

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

/// Histories and spectra of many runs, to be laid over one another.
namespace flowslide::study {

/// May an array of a page be needed for a curve?
bool is_for_curves(std::string_view array);

class Curves {
 public:
  /// What a chart shows, and the arrays of a page that it is read from.
  struct Kind {
    std::string name, title, x, y, unit;
    std::string time, array;
  };

  explicit Curves(std::size_t rows) : rows_(rows) {}
  void add(std::size_t row, const PageRun& run);

  [[nodiscard]] bool any() const;
  /// JSON: {charts: [{name, title, x, y, from, to, of}], arrays}. `of` is the curve of each row, -1
  /// for none: rows that share a shaking share its curves. Abscissae lie evenly between `from` and
  /// `to` of a curve, of a spectrum evenly in their logarithm.
  [[nodiscard]] std::string json() const;
  /// The ordinates, packed: one array per chart, one row per curve.
  [[nodiscard]] std::string arrays() const;

 private:
  struct Chart {
    Kind kind;
    std::vector<std::vector<double>> curves;
    std::vector<double> from, to;
    std::vector<int> of;
  };
  Chart& chart(const Kind& kind);
  [[nodiscard]] PageArrays packed_curves() const;
  static void put(Chart& chart, std::size_t row, std::vector<double> values, double from,
                  double to);

  std::size_t rows_;
  std::vector<Chart> charts_;
};

/// Values at `count` places evenly between the first and the last of `x`, straight between rows.
/// Empty for fewer than two rows, or where x does not grow.
std::vector<double> resampled(const std::vector<double>& x, const std::vector<double>& y,
                              std::size_t count);

}  // namespace flowslide::study
