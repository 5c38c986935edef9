#include "transfer/map/point_map.hpp"

#include "core/elementary.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Dense>

namespace flowslide {
namespace {

constexpr double kGrowth = 1.25;
constexpr int kMaxGrowths = 6;
constexpr std::size_t kMinSources = 4;
constexpr double kMaxAmplification = 4.0;
constexpr double kMinConditioning = 1e-3;  ///< smallest over largest eigenvalue of the moments

/// Sources sorted into square bins, in order of their index inside a bin.
class Bins {
 public:
  Bins(std::span<const MlsSource> sources, double width) : width_(width) {
    double xmax = -std::numeric_limits<double>::infinity(), ymax = xmax;
    x0_ = y0_ = std::numeric_limits<double>::infinity();
    for (const MlsSource& s : sources) {
      x0_ = std::min(x0_, s.position[0]);
      y0_ = std::min(y0_, s.position[1]);
      xmax = std::max(xmax, s.position[0]);
      ymax = std::max(ymax, s.position[1]);
    }
    nx_ = static_cast<std::int64_t>((xmax - x0_) / width_) + 1;
    ny_ = static_cast<std::int64_t>((ymax - y0_) / width_) + 1;
    start_.assign(static_cast<std::size_t>(nx_ * ny_) + 1, 0);
    for (const MlsSource& s : sources) ++start_[bin(s.position) + 1];
    for (std::size_t i = 1; i < start_.size(); ++i) start_[i] += start_[i - 1];
    index_.resize(sources.size());
    std::vector<std::size_t> fill(start_.begin(), start_.end() - 1);
    for (std::size_t i = 0; i < sources.size(); ++i)
      index_[fill[bin(sources[i].position)]++] = static_cast<std::int32_t>(i);
  }

  /// Candidates within `radius` of a point, and a few beyond, in ascending order.
  void near(Vec2 p, double radius, std::vector<std::int32_t>& out) const {
    out.clear();
    const auto cell = [this](double x, double origin, std::int64_t n) {
      return std::clamp<std::int64_t>(static_cast<std::int64_t>(std::floor((x - origin) / width_)),
                                      0, n - 1);
    };
    for (std::int64_t j = cell(p[1] - radius, y0_, ny_); j <= cell(p[1] + radius, y0_, ny_); ++j)
      for (std::int64_t i = cell(p[0] - radius, x0_, nx_); i <= cell(p[0] + radius, x0_, nx_); ++i)
        for (std::size_t k = start_[static_cast<std::size_t>(j * nx_ + i)];
             k < start_[static_cast<std::size_t>(j * nx_ + i) + 1]; ++k)
          out.push_back(index_[k]);
    std::sort(out.begin(), out.end());
  }

 private:
  [[nodiscard]] std::size_t bin(Vec2 p) const {
    const auto i = std::min(static_cast<std::int64_t>((p[0] - x0_) / width_), nx_ - 1);
    const auto j = std::min(static_cast<std::int64_t>((p[1] - y0_) / width_), ny_ - 1);
    return static_cast<std::size_t>(j * nx_ + i);
  }
  double width_, x0_, y0_;
  std::int64_t nx_ = 0, ny_ = 0;
  std::vector<std::size_t> start_;
  std::vector<std::int32_t> index_;
};

/// Quartic spline 1 - 6 s^2 + 8 s^3 - 3 s^4, s = r/R < 1.
double quartic_spline(double s) { return 1.0 + s * s * (-6.0 + s * (8.0 - 3.0 * s)); }

struct Fit {
  std::vector<std::int32_t> source;
  std::vector<double> weight;
};

/// Fills `fit` with the value of the linear fit at x as weights of the sources; false if unstable.
bool fit_linear(std::span<const MlsSource> sources, const std::vector<std::int32_t>& candidates,
                Vec2 x, double radius, Fit& fit) {
  fit.source.clear();
  fit.weight.clear();
  Eigen::Matrix3d moments = Eigen::Matrix3d::Zero();
  const auto basis = [&](std::int32_t k) {
    const Vec2& p = sources[static_cast<std::size_t>(k)].position;
    return Eigen::Vector3d(1.0, (p[0] - x[0]) / radius, (p[1] - x[1]) / radius);
  };
  for (const std::int32_t k : candidates) {
    const Eigen::Vector3d b = basis(k);
    const double s = hypot(b[1], b[2]);
    if (!(s < 1.0)) continue;
    const double w = quartic_spline(s);
    moments += w * b * b.transpose();
    fit.source.push_back(k);
    fit.weight.push_back(w);
  }
  if (fit.source.size() < kMinSources) return false;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(moments);
  if (!(eigen.eigenvalues()[0] > kMinConditioning * eigen.eigenvalues()[2])) return false;
  const Eigen::Vector3d row = eigen.eigenvectors() *
                              eigen.eigenvalues().cwiseInverse().asDiagonal() *
                              eigen.eigenvectors().row(0).transpose();
  double amplification = 0.0;
  for (std::size_t i = 0; i < fit.source.size(); ++i) {
    fit.weight[i] *= row.dot(basis(fit.source[i]));
    amplification += std::abs(fit.weight[i]);
  }
  return amplification <= kMaxAmplification;
}

}  // namespace

PointMap build_mls(std::span<const MlsSource> sources, std::span<const MlsTarget> targets,
                   double radius, const Progress& progress) {
  PointMap map;
  if (targets.empty()) return map;
  double mean_size = 0.0;
  for (const MlsSource& s : sources) mean_size += s.size / static_cast<double>(sources.size());
  const Bins bins(sources, radius * mean_size);
  std::vector<std::int32_t> candidates;
  Fit fit;
  for (const MlsTarget& t : targets) {
    progress.poll();
    double reach = radius * sources[static_cast<std::size_t>(t.home)].size;
    bool stable = false;
    for (int growth = 0; growth <= kMaxGrowths && !stable; ++growth, reach *= kGrowth) {
      bins.near(t.position, reach, candidates);
      stable = fit_linear(sources, candidates, t.position, reach, fit);
      if (stable && growth > 0) ++map.widened;
    }
    if (!stable) {
      fit.source.assign(1, t.home);
      fit.weight.assign(1, 1.0);
      ++map.nearest;
    }
    map.source.insert(map.source.end(), fit.source.begin(), fit.source.end());
    map.weight.insert(map.weight.end(), fit.weight.begin(), fit.weight.end());
    map.offset.push_back(map.source.size());
  }
  return map;
}

}  // namespace flowslide
