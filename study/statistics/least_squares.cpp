#include "study/statistics/least_squares.hpp"

#include "study/statistics/ranks.hpp"
#include "study/statistics/summary.hpp"

#include <algorithm>
#include <cmath>

namespace flowslide::study {
namespace {

/// Rotates a row into the triangle that the rows before it have made.
void add_row(std::vector<std::vector<double>>& triangle, std::vector<double> row) {
  const std::size_t n = triangle.size();
  for (std::size_t k = 0; k < n; ++k) {
    if (row[k] == 0.0) continue;
    const double a = triangle[k][k], b = row[k], r = std::sqrt(a * a + b * b);
    const double c = a / r, s = b / r;
    for (std::size_t j = k; j <= n; ++j) {
      const double upper = triangle[k][j], lower = row[j];
      triangle[k][j] = c * upper + s * lower;
      row[j] = c * lower - s * upper;
    }
  }
}

}  // namespace

std::vector<double> least_squares(const std::vector<std::vector<double>>& columns,
                                  const std::vector<double>& y) {
  const std::size_t n = columns.size();
  std::vector<std::vector<double>> triangle(n, std::vector<double>(n + 1, 0.0));
  std::vector<double> size(n, 0.0);
  for (std::size_t i = 0; i < y.size(); ++i) {
    std::vector<double> row;
    for (std::size_t k = 0; k < n; ++k) {
      row.push_back(columns[k][i]);
      size[k] = std::max(size[k], std::abs(columns[k][i]));
    }
    row.push_back(y[i]);
    add_row(triangle, std::move(row));
  }
  std::vector<double> c(n, 0.0);
  for (std::size_t k = n; k-- > 0;) {
    if (!(std::abs(triangle[k][k]) > 1e-10 * size[k])) return {};
    double sum = triangle[k][n];
    for (std::size_t j = k + 1; j < n; ++j) sum -= triangle[k][j] * c[j];
    c[k] = sum / triangle[k][k];
  }
  return c;
}

double share_explained(const std::vector<double>& y, const std::vector<double>& fitted) {
  const double middle = mean(y);
  double about_fit = 0.0, about_mean = 0.0;
  for (std::size_t i = 0; i < y.size(); ++i) {
    about_fit += (y[i] - fitted[i]) * (y[i] - fitted[i]);
    about_mean += (y[i] - middle) * (y[i] - middle);
  }
  return about_mean > 0.0 ? 1.0 - about_fit / about_mean : kUnset;
}

Line fit_line(const std::vector<double>& x, const std::vector<double>& y, const Resampling& how) {
  const Pairs pairs = without_gaps(x, y);
  Line line;
  constexpr std::size_t kFewest = 4;
  if (pairs.x.size() < kFewest) return line;
  const auto coefficient = [&](std::size_t which) {
    return [&pairs, which](const std::vector<std::size_t>& rows) {
      std::vector<std::vector<double>> columns(2);
      std::vector<double> drawn;
      for (const std::size_t row : rows) {
        columns[0].push_back(1.0);
        columns[1].push_back(pairs.x[row]);
        drawn.push_back(pairs.y[row]);
      }
      const std::vector<double> c = least_squares(columns, drawn);
      return c.empty() ? kUnset : c[which];
    };
  };
  const Resampling of_pairs = without_gaps(how, x, y);
  line.intercept = bootstrap(pairs.x.size(), of_pairs, coefficient(0));
  line.slope = bootstrap(pairs.x.size(), of_pairs, coefficient(1));
  std::vector<double> fitted;
  for (const double v : pairs.x) fitted.push_back(line.intercept.value + line.slope.value * v);
  line.r2 = share_explained(pairs.y, fitted);
  return line;
}

}  // namespace flowslide::study
