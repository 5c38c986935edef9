#include "transfer/map/point_map.hpp"

#include "distorted_mesh.hpp"

#include <cmath>

#include <catch2/catch.hpp>

using namespace flowslide;
using flowslide::test::distorted_mesh;
using flowslide::test::Noise;

namespace {

double linear(Vec2 p) { return 3.0 - 2.0 * p[0] + 0.7 * p[1]; }

std::vector<MlsSource> centres(const QuadMesh& mesh) {
  std::vector<MlsSource> s;
  for (std::size_t e = 0; e < mesh.num_elements(); ++e)
    s.push_back({centroid(corners(mesh, mesh.nodes, e)), 1.0});
  return s;
}

double largest_error(const PointMap& map, const std::vector<MlsSource>& sources,
                     const std::vector<MlsTarget>& targets, double (*field)(Vec2)) {
  double worst = 0.0;
  for (std::size_t t = 0; t < targets.size(); ++t) {
    double value = 0.0;
    for (std::size_t k = map.offset[t]; k < map.offset[t + 1]; ++k)
      value += map.weight[k] * field(sources[static_cast<std::size_t>(map.source[k])].position);
    worst = std::max(worst, std::abs(value - field(targets[t].position)));
  }
  return worst;
}

}  // namespace

TEST_CASE("Moving least squares reproduce a linear field up to the boundary", "[transfer]") {
  const QuadMesh mesh = distorted_mesh(10, 8, 500.0, 10.0, 8.0, 0.3, 1);
  const std::vector<MlsSource> sources = centres(mesh);
  std::vector<MlsTarget> targets;
  Noise noise(2);
  for (std::size_t e = 0; e < mesh.num_elements(); ++e)
    targets.push_back(
        {{sources[e].position[0] + 0.5 * noise(), sources[e].position[1] + 0.5 * noise()},
         static_cast<std::int32_t>(e)});
  const PointMap map = build_mls(sources, targets, 1.9);
  REQUIRE(map.num_targets() == targets.size());
  CHECK(map.nearest == 0);
  CHECK(largest_error(map, sources, targets, linear) < 1e-10);
}

TEST_CASE("Moving least squares converge at second order", "[transfer]") {
  const auto wave = [](Vec2 p) { return std::sin(0.8 * p[0]) * std::cos(0.5 * p[1]); };
  double error[2];
  for (const int level : {0, 1}) {
    const int n = 12 << level;
    const double h = 12.0 / n;
    std::vector<MlsSource> sources = centres(distorted_mesh(n, n, 0.0, 12.0, 12.0, 0.1, 3));
    for (MlsSource& s : sources) s.size = h;
    std::vector<MlsTarget> targets;
    for (std::size_t e = 0; e < sources.size(); ++e)
      targets.push_back({{sources[e].position[0] + 0.25 * h, sources[e].position[1]},
                         static_cast<std::int32_t>(e)});
    error[level] = largest_error(build_mls(sources, targets, 1.9), sources, targets, wave);
  }
  CHECK(std::log2(error[0] / error[1]) > 1.6);
}

TEST_CASE("Too few or collinear sources widen the radius, then fall back to the own element",
          "[transfer]") {
  std::vector<MlsSource> row;
  for (int i = 0; i < 8; ++i) row.push_back({{1.0 * i, 0.0}, 1.0});
  const std::vector<MlsTarget> target{{{3.2, 0.3}, 3}};
  const PointMap collinear = build_mls(row, target, 1.9);
  CHECK(collinear.nearest == 1);
  REQUIRE(collinear.source.size() == 1);
  CHECK(collinear.source[0] == 3);
  CHECK(collinear.weight[0] == 1.0);

  for (int i = 0; i < 8; ++i) row.push_back({{1.0 * i, 3.5}, 1.0});
  const PointMap wide = build_mls(row, target, 1.9);
  CHECK(wide.widened == 1);
  CHECK(wide.nearest == 0);
  CHECK(largest_error(wide, row, target, linear) < 1e-10);
}
