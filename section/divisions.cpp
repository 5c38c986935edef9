#include "section/divisions.hpp"

#include "core/check.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Dense>
#include <fmt/format.h>

namespace flowslide {
namespace {

/// One linear equation between the numbers of the segments: row . n = right.
struct Equations {
  Eigen::MatrixXd matrix;
  Eigen::VectorXd right;
  std::vector<std::string> origin;  ///< block, for messages
};

std::vector<std::pair<int, int>> opposite_sides() { return {{0, 2}, {1, 3}}; }

Equations equations(const Layout& layout, const SectionConfig& config) {
  std::vector<Eigen::VectorXd> rows;
  std::vector<double> right;
  Equations e;
  const auto n = static_cast<Eigen::Index>(layout.segments.size());
  for (const LayoutBlock& block : layout.blocks) {
    const auto add = [&](int side, Eigen::VectorXd& row, double sign) {
      for (const DirectedSegment& s : block.sides[side]) row(s.segment) += sign;
    };
    for (const auto& [a, b] : opposite_sides()) {
      Eigen::VectorXd row = Eigen::VectorXd::Zero(n);
      add(a, row, 1.0);
      add(b, row, -1.0);
      rows.push_back(row);
      right.push_back(0.0);
      e.origin.push_back(block.name);
    }
    const std::vector<int>& given = config.blocks.at(block.name).divisions;
    for (std::size_t side = 0; side < given.size(); ++side) {
      if (given[side] == 0) continue;
      Eigen::VectorXd row = Eigen::VectorXd::Zero(n);
      add(static_cast<int>(side), row, 1.0);
      rows.push_back(row);
      right.push_back(given[side]);
      e.origin.push_back(block.name);
    }
  }
  e.matrix.resize(static_cast<Eigen::Index>(rows.size()), n);
  e.right.resize(static_cast<Eigen::Index>(rows.size()));
  for (std::size_t i = 0; i < rows.size(); ++i) {
    e.matrix.row(static_cast<Eigen::Index>(i)) = rows[i].transpose();
    e.right(static_cast<Eigen::Index>(i)) = right[i];
  }
  return e;
}

/// n = shift + map . free: the equations solved for some of the numbers by Gauss and Jordan.
struct Solution {
  Eigen::MatrixXd map;
  Eigen::VectorXd shift;
  std::vector<Eigen::Index> free;
};

Solution solve(Equations e) {
  const Eigen::Index n = e.matrix.cols();
  std::vector<Eigen::Index> pivot_row(static_cast<std::size_t>(n), -1);
  for (Eigen::Index r = 0; r < e.matrix.rows(); ++r) {
    Eigen::Index column = -1;
    for (Eigen::Index c = 0; c < n; ++c) {
      const double size = std::abs(e.matrix(r, c));
      if (size < 1e-9) continue;
      // Pivots of one keep whole numbers whole.
      if (column < 0 || std::abs(size - 1.0) < std::abs(std::abs(e.matrix(r, column)) - 1.0))
        column = c;
    }
    if (column < 0) {
      validate(std::abs(e.right(r)) < 1e-9,
               "block '{}': the numbers of elements contradict each other (opposite sides must "
               "have the same, and blocks share them along their sides). Leave out `divisions` of "
               "this block or of its neighbours",
               e.origin[static_cast<std::size_t>(r)]);
      continue;
    }
    const double pivot = e.matrix(r, column);
    e.matrix.row(r) /= pivot;
    e.right(r) /= pivot;
    for (Eigen::Index k = 0; k < e.matrix.rows(); ++k) {
      const double factor = e.matrix(k, column);
      if (k == r || factor == 0.0) continue;
      e.matrix.row(k) -= factor * e.matrix.row(r);
      e.right(k) -= factor * e.right(r);
    }
    pivot_row[static_cast<std::size_t>(column)] = r;
  }
  Solution s;
  for (Eigen::Index c = 0; c < n; ++c)
    if (pivot_row[static_cast<std::size_t>(c)] < 0) s.free.push_back(c);
  const auto free = static_cast<Eigen::Index>(s.free.size());
  s.map = Eigen::MatrixXd::Zero(n, free);
  s.shift = Eigen::VectorXd::Zero(n);
  for (Eigen::Index f = 0; f < free; ++f) s.map(s.free[static_cast<std::size_t>(f)], f) = 1.0;
  for (Eigen::Index c = 0; c < n; ++c) {
    const Eigen::Index r = pivot_row[static_cast<std::size_t>(c)];
    if (r < 0) continue;
    s.shift(c) = e.right(r);
    for (Eigen::Index f = 0; f < free; ++f)
      s.map(c, f) = -e.matrix(r, s.free[static_cast<std::size_t>(f)]);
  }
  return s;
}

/// Squared misfit relative to the number, so that too few elements weigh more than too many; with
/// a wall before numbers below one and fractions.
double cost_of(const Eigen::VectorXd& n, const Eigen::VectorXd& wanted) {
  double cost = 0.0;
  for (Eigen::Index i = 0; i < n.size(); ++i) {
    cost += (n(i) - wanted(i)) * (n(i) - wanted(i)) / std::max(n(i), 0.5);
    if (n(i) < 1.0 - 1e-9) cost += 1e6 * (1.0 - n(i)) * (1.0 - n(i));
    const double fraction = n(i) - std::round(n(i));
    if (std::abs(fraction) > 1e-9) cost += 1e6 * fraction * fraction;
  }
  return cost;
}

/// Changes of one or of two free numbers by one, while that helps.
Eigen::VectorXd improve(const Solution& s, Eigen::VectorXd free, const Eigen::VectorXd& wanted) {
  Eigen::VectorXd n = s.shift + s.map * free;
  double best = cost_of(n, wanted);
  for (bool better = true; better;) {
    better = false;
    const auto attempt = [&](const Eigen::VectorXd& change, auto&& accept) {
      const double cost = cost_of(n + change, wanted);
      if (!(cost < best - 1e-12)) return;
      best = cost;
      n += change;
      accept();
      better = true;
    };
    for (Eigen::Index i = 0; i < free.size(); ++i)
      for (const double di : {1.0, -1.0}) {
        attempt(di * s.map.col(i), [&] { free(i) += di; });
        for (Eigen::Index k = 0; k < i; ++k)
          for (const double dk : {1.0, -1.0})
            attempt(di * s.map.col(i) + dk * s.map.col(k), [&] {
              free(i) += di;
              free(k) += dk;
            });
      }
  }
  return s.shift + s.map * free;
}

void check_numbers(const Layout& layout, const Eigen::VectorXd& n) {
  for (Eigen::Index i = 0; i < n.size(); ++i) {
    const Segment& s = layout.segments[static_cast<std::size_t>(i)];
    const double value = n(i);
    validate(
        value > 1.0 - 1e-6 && std::abs(value - std::round(value)) < 1e-6,
        "block '{}': no whole numbers of elements make opposite sides equal (the side "
        "({}, {})-({}, {}) would get {:.3g}). Choose other corners, set `divisions`, or divide "
        "the block",
        layout.blocks[s.left >= 0 ? s.left : s.right].name, layout.points[s.a][0],
        layout.points[s.a][1], layout.points[s.b][0], layout.points[s.b][1], value);
  }
}

}  // namespace

std::vector<int> divide(const Layout& layout, const SectionConfig& config) {
  const Solution s = solve(equations(layout, config));
  const auto count = static_cast<Eigen::Index>(layout.segments.size());
  Eigen::VectorXd wanted(count), weight(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    wanted(i) = std::max(1.0, layout.segments[static_cast<std::size_t>(i)].elements);
    weight(i) = 1.0 / wanted(i);
  }
  // The best real numbers, rounded, are the start of the search among whole ones.
  const Eigen::MatrixXd normal = s.map.transpose() * weight.asDiagonal() * s.map;
  const Eigen::VectorXd load = s.map.transpose() * weight.asDiagonal() * (wanted - s.shift);
  Eigen::VectorXd free = normal.ldlt().solve(load);
  for (Eigen::Index i = 0; i < free.size(); ++i) free(i) = std::max(1.0, std::round(free(i)));
  const Eigen::VectorXd n = improve(s, free, wanted);
  check_numbers(layout, n);
  std::vector<int> divisions;
  for (Eigen::Index i = 0; i < count; ++i) divisions.push_back(static_cast<int>(std::lround(n(i))));
  return divisions;
}

}  // namespace flowslide
