#include "importers/plausibility.hpp"

#include "core/check.hpp"
#include "core/elementary.hpp"
#include "core/median.hpp"

#include <algorithm>
#include <cmath>

namespace flowslide {
namespace {

constexpr double kLightest = 10e3;    // [N/m3] below every saturated soil
constexpr double kHeaviest = 30e3;    // [N/m3] above every soil
constexpr double kNoPressure = 0.01;  // of the largest vertical stress
constexpr double kJump = 0.3;         // allowed change from gravity to the first row
constexpr std::size_t kSamples = 200;
// A node moves at most as far as its speed carries it. It comes back within a step of a second or
// less, so that a small part of the way is seen only; at 10 Hz that is a thirtieth.
constexpr double kTooSlow = 10.0, kTooFast = 100.0;
constexpr double kLongestStep = 1.0;  // [s]
constexpr double kNoWay = 1e-4;       // [m]

// Highest point of the mesh above x.
double surface_height(const QuadMesh& mesh, double x) {
  double top = -std::numeric_limits<double>::infinity();
  for (const auto& nodes : mesh.elements) {
    for (std::size_t i = 0; i < 4; ++i) {
      const Vec2& a = mesh.nodes[static_cast<std::size_t>(nodes[i])];
      const Vec2& b = mesh.nodes[static_cast<std::size_t>(nodes[(i + 1) % 4])];
      if (x < std::min(a[0], b[0]) || x > std::max(a[0], b[0])) continue;
      const double s = b[0] == a[0] ? 1.0 : (x - a[0]) / (b[0] - a[0]);
      top = std::max({top, a[1] + s * (b[1] - a[1]), b[0] == a[0] ? a[1] : top});
    }
  }
  return top;
}

double mean_pressure(const QuadMesh& mesh, const FemFrame& frame, std::size_t e) {
  double sum = 0.0;
  for (const std::int32_t n : mesh.elements[e])
    sum += frame.pore_pressure[static_cast<std::size_t>(n)];
  return 0.25 * sum;
}

// Median unit weight over sampled elements in the lower two thirds of the section [N/m3].
double apparent_unit_weight(const QuadMesh& mesh, const FemFrame& gravity) {
  struct Sample {
    double depth;
    double weight;
  };
  std::vector<Sample> samples;
  double deepest = 0.0;
  const std::size_t stride = std::max<std::size_t>(1, mesh.num_elements() / kSamples);
  for (std::size_t e = 0; e < mesh.num_elements(); e += stride) {
    const Vec2 c = centroid(corners(mesh, mesh.nodes, e));
    const double depth = surface_height(mesh, c[0]) - c[1];
    const double total = mean_pressure(mesh, gravity, e) - gravity.stress[e][1];
    samples.push_back({depth, total / depth});
    deepest = std::max(deepest, depth);
  }
  std::vector<double> weights;
  for (const Sample& s : samples)
    if (s.depth > deepest / 3.0) weights.push_back(s.weight);
  return median(std::move(weights));
}

}  // namespace

std::vector<std::string> gravity_warnings(const QuadMesh& mesh, const FemFrame& gravity) {
  std::vector<std::string> warnings;
  std::size_t tension = 0, lying = 0;
  double largest_stress = 0.0;
  for (const Stress<2>& s : gravity.stress) {
    tension += s[1] > 0.0;
    lying += s[0] < s[1];
    largest_stress = std::max(largest_stress, std::abs(s[1]));
  }
  if (2 * tension > gravity.stress.size()) {
    warnings.push_back(
        fmt::format("gravity: the vertical effective stress is positive in {} of {} elements "
                    "(OpenSees: tension positive) was the sign changed, or is the column order of "
                    "`columns.stress` another?",
                    tension, gravity.stress.size()));
  }
  // Soil that was never loaded by more has 0.4 to 0.6 of the vertical stress in the horizontal.
  if (2 * tension <= gravity.stress.size() && 2 * lying > gravity.stress.size())
    warnings.push_back(
        fmt::format("gravity: the horizontal effective stress exceeds the vertical one in {} of {} "
                    "elements. Is the order of `columns.stress` right, which is xx, yy, ...?",
                    lying, gravity.stress.size()));
  const double weight = apparent_unit_weight(mesh, gravity);
  if (2 * tension <= gravity.stress.size() && !(weight >= kLightest && weight <= kHeaviest)) {
    warnings.push_back(
        fmt::format("gravity: total vertical stress grows by {:.3g} kN/m3 with depth (soil: 10 to "
                    "30) are `units.stress` and `units.length`, the order of the recorders and the "
                    "gravity row right?",
                    weight / 1e3));
  }
  double largest_pressure = 0.0;
  for (const double u : gravity.pore_pressure)
    largest_pressure = std::max(largest_pressure, std::abs(u));
  if (largest_pressure < kNoPressure * largest_stress) {
    warnings.push_back(
        "gravity: pore pressure is nowhere 1 % of the vertical stress (a dry model?) pore pressure "
        "is the velocity of the last degree of freedom: `-dof 3 vel`, not disp or accel");
  }
  return warnings;
}

std::vector<std::string> start_warnings(const FemFrame& gravity, const FemFrame& first) {
  std::vector<std::string> warnings;
  const auto compare = [&](std::string_view what, auto value, std::size_t count,
                           std::string_view hint) {
    double change = 0.0;
    double size = 0.0;
    for (std::size_t i = 0; i < count; ++i) {
      change += std::abs(value(first, i) - value(gravity, i));
      size += std::abs(value(gravity, i));
    }
    const double share = change / size;
    if (size > 0.0 && share > kJump)
      warnings.push_back(fmt::format(
          "first shaking row (t = {} s): {} differs from gravity by {:.0f} % on average "
          "{}",
          first.time, what, 100.0 * share, hint));
  };
  compare(
      "pore pressure", [](const FemFrame& f, std::size_t i) { return f.pore_pressure[i]; },
      first.pore_pressure.size(),
      "(recorded as disp or accel? it is `-dof 3 vel`; or the gravity row is of another stage)");
  compare(
      "vertical effective stress", [](const FemFrame& f, std::size_t i) { return f.stress[i][1]; },
      first.stress.size(), "(is the gravity row of another stage or model?)");
  return warnings;
}

MotionWatch::MotionWatch(const QuadMesh& mesh) : mesh_(mesh) {
  Vec2 low = mesh.nodes.front(), high = low;
  for (const Vec2& p : mesh.nodes)
    for (int d = 0; d < 2; ++d) {
      low[d] = std::min(low[d], p[d]);
      high[d] = std::max(high[d], p[d]);
    }
  length_ = std::max(high[0] - low[0], high[1] - low[1]);
  height_ = high[1] - low[1];
}

void MotionWatch::look_at(const FemFrame& frame) {
  std::vector<Vec2> positions = mesh_.nodes;
  for (std::size_t n = 0; n < positions.size(); ++n) {
    const Vec2& u = frame.displacement[n];
    const double size = hypot(u[0], u[1]);
    validate(
        size <= length_ || std::isnan(size),
        "displacement: node {} has moved by {:.4g} m at t = {:.6g} s, farther than the section "
        "is long ({:.4g} m) (the run had diverged, or the unit is another) check "
        "`units.length`, or end the record before",
        mesh_.node_tags[n], size, frame.time, length_);
    if (size > largest_) {
      largest_ = size;
      largest_time_ = frame.time;
      largest_node_ = n;
    }
    for (int d = 0; d < 2; ++d) positions[n][d] += u[d];
  }
  compare_velocity(frame);
  if (folded_ > 0) return;
  for (std::size_t e = 0; e < mesh_.num_elements(); ++e) {
    if (area(corners(mesh_, positions, e)) > 0.0) continue;
    if (folded_++ == 0) folded_element_ = e;
    folded_time_ = frame.time;
  }
}

void MotionWatch::compare_velocity(const FemFrame& frame) {
  const double step = frame.time - last_time_;
  if (step > 0.0 && step <= kLongestStep) {
    double moved = 0.0, carried = 0.0;
    for (std::size_t n = 0; n < mesh_.num_nodes(); ++n) {
      const Vec2 &u = frame.displacement[n], &u0 = last_displacement_[n];
      const Vec2 &v = frame.velocity[n], &v0 = last_velocity_[n];
      moved += hypot(u[0] - u0[0], u[1] - u0[1]);
      carried += 0.5 * step * (hypot(v[0], v[1]) + hypot(v0[0], v0[1]));
    }
    moved_ += moved / static_cast<double>(mesh_.num_nodes());
    carried_ += carried / static_cast<double>(mesh_.num_nodes());
  }
  last_time_ = frame.time;
  last_displacement_ = frame.displacement;
  last_velocity_ = frame.velocity;
}

std::vector<std::string> MotionWatch::warnings() const {
  std::vector<std::string> warnings;
  if (std::max(moved_, carried_) > kNoWay &&
      (moved_ > kTooSlow * carried_ || carried_ > kTooFast * moved_))
    warnings.push_back(fmt::format(
        "velocity: nodes move by {:.3g} m in all, but their velocity would carry them {:.3g} m. "
        "Was `vel` recorded, in the units of the displacement and of the time?",
        moved_, carried_));
  if (largest_ > 0.5 * height_)
    warnings.push_back(fmt::format(
        "displacement: node {} has moved by {:.4g} m at t = {:.6g} s, more than half the height of "
        "the section of {:.4g} m. Is `units.length` right?",
        mesh_.node_tags[largest_node_], largest_, largest_time_, height_));
  if (folded_ > 0)
    warnings.push_back(
        fmt::format("displacement: {} elements are folded from t = {:.6g} s on, such as {}. Later "
                    "states cannot "
                    "be transferred.",
                    folded_, folded_time_, mesh_.element_tags[folded_element_]));
  return warnings;
}

}  // namespace flowslide
