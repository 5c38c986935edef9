#include "section/quality.hpp"

#include "core/conventions.hpp"
#include "core/elementary.hpp"
#include "core/median.hpp"
#include "section/outline.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace flowslide {
namespace {

Vec2 middle(Vec2 a, Vec2 b) { return {0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])}; }

struct Shape {
  double jacobian_ratio, aspect, angle, shortest, longest, thickness;
};

Shape measure(const std::array<Vec2, 4>& q) {
  Shape s{};
  double smallest = 0.0, largest = 0.0;
  for (std::size_t k = 0; k < 4; ++k) {
    const Vec2 c = q[k], n = q[(k + 1) % 4], p = q[(k + 3) % 4];
    const double a[2] = {n[0] - c[0], n[1] - c[1]}, b[2] = {p[0] - c[0], p[1] - c[1]};
    const double jacobian = a[0] * b[1] - a[1] * b[0];
    const double edge = distance(c, n);
    const double angle = atan2(jacobian, a[0] * b[0] + a[1] * b[1]) * 180.0 / kPi;
    smallest = k == 0 ? jacobian : std::min(smallest, jacobian);
    largest = k == 0 ? jacobian : std::max(largest, jacobian);
    s.shortest = k == 0 ? edge : std::min(s.shortest, edge);
    s.longest = std::max(s.longest, edge);
    s.angle = std::max(s.angle, std::abs(90.0 - angle));
  }
  s.jacobian_ratio = smallest / largest;
  const double across = distance(middle(q[0], q[1]), middle(q[2], q[3]));
  const double along = distance(middle(q[1], q[2]), middle(q[3], q[0]));
  s.aspect = std::max(across / along, along / across);
  s.thickness = area(q) / s.longest;
  return s;
}

}  // namespace

MeshQuality measure_quality(const QuadMesh& mesh) {
  MeshQuality quality;
  const auto take = [](WorstElement& worst, double value, std::size_t e, bool smaller) {
    if (e == 0 || (smaller ? value < worst.value : value > worst.value)) worst = {value, e};
  };
  std::vector<double> thickness;
  for (std::size_t e = 0; e < mesh.num_elements(); ++e) {
    const Shape s = measure(corners(mesh, mesh.nodes, e));
    take(quality.jacobian_ratio, s.jacobian_ratio, e, true);
    take(quality.aspect, s.aspect, e, false);
    take(quality.angle, s.angle, e, false);
    take(quality.shortest_edge, s.shortest, e, true);
    take(quality.thickness, s.thickness, e, true);
    thickness.push_back(s.thickness);
  }
  if (!thickness.empty()) quality.median_thickness = median(std::move(thickness));
  return quality;
}

std::vector<std::string> quality_notes(const QuadMesh& mesh, const MeshQuality& q) {
  std::vector<std::string> notes;
  const auto place = [&mesh](const WorstElement& worst) {
    const Vec2 c = centroid(corners(mesh, mesh.nodes, worst.element));
    return fmt::format("element {} at ({:.4g}, {:.4g})", mesh.element_tags[worst.element], c[0],
                       c[1]);
  };
  if (q.jacobian_ratio.value < 0.2)
    notes.push_back(
        fmt::format("{} has a Jacobian ratio of {:.3g} (1 is a parallelogram; results "
                    "suffer below 0.2)",
                    place(q.jacobian_ratio), q.jacobian_ratio.value));
  if (q.aspect.value > 10.0)
    notes.push_back(
        fmt::format("{} is {:.3g} times longer than wide", place(q.aspect), q.aspect.value));
  if (q.angle.value > 75.0)
    notes.push_back(fmt::format("{} has a corner of {:.3g} degrees less or more than 90",
                                place(q.angle), q.angle.value));
  // The thinnest element sets the explicit steps of all.
  if (const double price = q.median_thickness / q.thickness.value; price > 4.0)
    notes.push_back(fmt::format(
        "{} is {:.2g} m thin where half of the elements are thicker than {:.2g} m, so that a "
        "shaking takes some {:.0f} times more steps than the rest needs (as many elements cross a "
        "narrow part as a wide one) give fewer `divisions` across it, or a larger size",
        place(q.thickness), q.thickness.value, q.median_thickness, price));
  return notes;
}

}  // namespace flowslide
