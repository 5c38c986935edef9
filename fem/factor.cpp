#include "fem/factor.hpp"

#include "core/check.hpp"
#include "core/memory.hpp"
#include "core/pack.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

namespace flowslide::fem {
namespace {

using Sparse = Eigen::SparseMatrix<double>;

constexpr std::int32_t kBlock = 8;  ///< rows solved at a time, and numbers of a row
constexpr std::size_t kBlockSize = kBlock * kBlock;

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

/// A row of a block. Sums over its places have the same order however wide registers are.
using Block = VectorOf<kBlock>::Real;

void load(Block& to, const double* from) { std::memcpy(&to, from, sizeof to); }
void store(double* to, const Block& from) { std::memcpy(to, &from, sizeof from); }

/// sum_k row k of the matrix times y_k.
void combine(const double* matrix, const double* y, double* to) {
  Block sum{}, row;
  for (std::int32_t k = 0; k < kBlock; ++k) {
    load(row, matrix + kBlock * k);
    sum += row * y[k];
  }
  store(to, sum);
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
  reach_ = (width_ + kBlock - 1) / kBlock * kBlock;
  const std::size_t blocks = (static_cast<std::size_t>(n_) + kBlock - 1) / kBlock;
  skip_.resize(blocks);
  left_.resize(blocks * kBlock * reach_);
  blocks_.resize(2 * blocks * kBlockSize);
  work_.assign(reach_ + blocks * kBlock, 0.0);
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
  for (std::int32_t i = 0; i < n_; i += kBlock) set_block(i);
}

/// What `solve` needs of the rows from `i` on.
void BandFactor::set_block(std::int32_t i) {
  const std::int32_t w = width_;
  const auto element = [&](std::int32_t r, std::int32_t c) {
    if (r >= n_ || c < 0 || c < r - w) return r == c ? 1.0 : 0.0;
    return rows_[static_cast<std::size_t>(r) * (w + 1) + (c - r + w)];
  };
  double* left = left_.data() + static_cast<std::size_t>(i) * reach_;  // empty for a diagonal
  std::int32_t first = reach_;
  for (std::int32_t r = i; r < i + kBlock; ++r)
    for (std::int32_t c = 0; c < reach_; ++c) {
      *left = element(r, i - reach_ + c);
      if (*left++ != 0.0) first = std::min(first, c);
    }
  skip_[i / kBlock] = first / kBlock * kBlock;
  double* block = &blocks_[2 * kBlock * static_cast<std::size_t>(i)];
  double* transpose = block + kBlockSize;
  std::fill(block, block + 2 * kBlockSize, 0.0);
  for (std::int32_t c = 0; c < kBlock; ++c)
    for (std::int32_t r = c; r < kBlock; ++r) {
      double sum = r == c ? -1.0 : 0.0;
      for (std::int32_t k = c; k < r; ++k) sum += element(i + r, i + k) * block[kBlock * k + c];
      const double inverse = i + r < n_ ? inverse_[i + r] : 1.0;
      block[kBlock * r + c] = transpose[kBlock * c + r] = -inverse * sum;
    }
}

void BandFactor::solve(double* b) {
  double* x = work_.data() + reach_;
  for (std::int32_t u = 0; u < n_; ++u) x[position_[u]] = b[u];
  const auto left = [&](std::int32_t i, std::int32_t r) {
    return left_.data() + static_cast<std::size_t>(i + r) * reach_;
  };
  const auto block = [&](std::int32_t i) {
    return &blocks_[2 * kBlock * static_cast<std::size_t>(i)];
  };
  std::array<double, kBlock> y;
  Block row, part;
  for (std::int32_t i = 0; i < n_; i += kBlock) {
    for (std::int32_t r = 0; r < kBlock; ++r) {
      const double *l = left(i, r), *before = x + i - reach_;
      Block sum{};
      for (std::int32_t k = skip_[i / kBlock]; k < reach_; k += kBlock) {
        load(row, l + k);
        load(part, before + k);
        sum += row * part;
      }
      y[r] = x[i + r] -
             (((sum[0] + sum[1]) + (sum[2] + sum[3])) + ((sum[4] + sum[5]) + (sum[6] + sum[7])));
    }
    combine(block(i) + kBlockSize, y.data(), x + i);
  }
  for (std::int32_t i = (n_ - 1) / kBlock * kBlock; i >= 0; i -= kBlock) {
    std::copy(x + i, x + i + kBlock, y.begin());
    combine(block(i), y.data(), x + i);
    for (std::int32_t k = skip_[i / kBlock]; k < reach_; k += kBlock) {
      Block sum{};
      for (std::int32_t r = 0; r < kBlock; ++r) {
        load(row, left(i, r) + k);
        sum += row * x[i + r];
      }
      load(part, x + i - reach_ + k);
      store(x + i - reach_ + k, part - sum);
    }
  }
  for (std::int32_t u = 0; u < n_; ++u) b[u] = x[position_[u]];
}

}  // namespace flowslide::fem
