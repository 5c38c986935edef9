#include "fem/factor.hpp"

#include "core/check.hpp"
#include "core/memory.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace flowslide::fem {
namespace {

using Sparse = Eigen::SparseMatrix<double>;

std::vector<std::vector<std::int32_t>> neighbours(const Sparse& m) {
  std::vector<std::vector<std::int32_t>> r(m.rows());
  for (std::int32_t c = 0; c < m.outerSize(); ++c) {
    for (Sparse::InnerIterator it(m, c); it; ++it) {
      if (it.row() == c) continue;
      r[c].push_back(static_cast<std::int32_t>(it.row()));
      r[it.row()].push_back(c);
    }
  }
  for (auto& list : r) {
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
  }
  return r;
}

/// Unknowns in breadth-first order from `start`, neighbours by ascending degree.
std::vector<std::int32_t> breadth_first(const std::vector<std::vector<std::int32_t>>& graph,
                                        std::int32_t start, std::vector<std::uint8_t> seen) {
  std::vector<std::int32_t> order{start};
  seen[start] = 1;
  for (std::size_t at = 0; at < order.size(); ++at) {
    const std::size_t first = order.size();
    for (const std::int32_t next : graph[order[at]]) {
      if (!seen[next]) order.push_back(next);
      seen[next] = 1;
    }
    std::stable_sort(order.begin() + first, order.end(), [&](std::int32_t a, std::int32_t b) {
      return graph[a].size() < graph[b].size();
    });
  }
  return order;
}

std::vector<std::int32_t> cuthill_mckee(const Sparse& m) {
  const auto graph = neighbours(m);
  const auto n = static_cast<std::int32_t>(m.rows());
  std::vector<std::uint8_t> seen(n, 0);
  std::vector<std::int32_t> order;
  for (std::int32_t i = 0; i < n; ++i) {
    if (seen[i]) continue;
    // the far end of the far end lies at an end of the section
    std::int32_t start = i;
    for (int pass = 0; pass < 2; ++pass) start = breadth_first(graph, start, seen).back();
    for (const std::int32_t u : breadth_first(graph, start, seen)) {
      order.push_back(u);
      seen[u] = 1;
    }
  }
  std::reverse(order.begin(), order.end());
  return order;
}

/// Sum of a_k b_k in eight partial sums, which registers of any width can hold.
double dot(const double* a, const double* b, std::int32_t count) {
  std::array<double, 8> part{};
  std::int32_t k = 0;
  for (; k + 8 <= count; k += 8)
    for (std::size_t i = 0; i < 8; ++i) part[i] += a[k + i] * b[k + i];
  for (std::size_t i = 0; k < count; ++i, ++k) part[i] += a[k] * b[k];
  return ((part[0] + part[1]) + (part[2] + part[3])) + ((part[4] + part[5]) + (part[6] + part[7]));
}

}  // namespace

BandFactor::BandFactor(const Sparse& pattern) : n_(static_cast<std::int32_t>(pattern.rows())) {
  const std::vector<std::int32_t> order = cuthill_mckee(pattern);
  position_.resize(n_);
  for (std::int32_t i = 0; i < n_; ++i) position_[order[i]] = i;
  for (std::int32_t c = 0; c < pattern.outerSize(); ++c)
    for (Sparse::InnerIterator it(pattern, c); it; ++it)
      width_ = std::max(width_, std::abs(position_[it.row()] - position_[c]));
  const double bytes = 8.0 * n_ * (width_ + 1.0);
  if (bytes > 1e8)
    need_memory(bytes, fmt::format("a system of {} unknowns, {} wide,", n_, width_),
                "use larger elements");
  rows_.resize(static_cast<std::size_t>(n_) * (width_ + 1));
  inverse_.resize(n_);
  work_.resize(n_);
}

void BandFactor::factorise(const Sparse& matrix) {
  const std::int32_t w = width_;
  std::fill(rows_.begin(), rows_.end(), 0.0);
  for (std::int32_t c = 0; c < matrix.outerSize(); ++c) {
    for (Sparse::InnerIterator it(matrix, c); it; ++it) {
      const std::int32_t i = position_[it.row()], j = position_[c];
      if (j <= i) rows_[static_cast<std::size_t>(i) * (w + 1) + (j - i + w)] = it.value();
    }
  }
  for (std::int32_t i = 0; i < n_; ++i) {
    const std::int32_t first = std::max(0, i - w);
    double* row = &rows_[static_cast<std::size_t>(i) * (w + 1)] + (first - i + w);
    for (std::int32_t j = first; j <= i; ++j) {
      const std::int32_t shared = std::max(first, j - w);
      const double* a = row + (shared - first);
      const double* b = &rows_[static_cast<std::size_t>(j) * (w + 1)] + (shared - j + w);
      const double start = row[j - first];
      double s = start;
      for (std::int32_t k = 0; k < j - shared; ++k) s -= a[k] * b[k];
      if (j < i) {
        row[j - first] = s * inverse_[j];
        continue;
      }
      if (!(s > 1e-13 * start && std::isfinite(s)))
        throw NumericsError(fmt::format(
            "the matrix of the section is singular at unknown {} (its pivot is {:g}) a part of the "
            "section is not held, or pore pressure has no boundary",
            i, s));
      inverse_[i] = 1.0 / std::sqrt(s);
    }
  }
}

void BandFactor::solve(double* b) {
  const std::int32_t w = width_;
  double* x = work_.data();
  for (std::int32_t u = 0; u < n_; ++u) x[position_[u]] = b[u];
  for (std::int32_t i = 0; i < n_; ++i) {
    const std::int32_t first = std::max(0, i - w), count = i - first;
    const double* row = &rows_[static_cast<std::size_t>(i) * (w + 1)] + (w - count);
    x[i] = (x[i] - dot(row, x + first, count)) * inverse_[i];
  }
  for (std::int32_t i = n_; i-- > 0;) {
    const std::int32_t first = std::max(0, i - w), count = i - first;
    const double* row = &rows_[static_cast<std::size_t>(i) * (w + 1)] + (w - count);
    double* above = x + first;
    const double xi = x[i] *= inverse_[i];
#pragma omp simd
    for (std::int32_t k = 0; k < count; ++k) above[k] -= row[k] * xi;
  }
  for (std::int32_t u = 0; u < n_; ++u) b[u] = x[position_[u]];
}

}  // namespace flowslide::fem
