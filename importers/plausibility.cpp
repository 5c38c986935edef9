#include "importers/plausibility.hpp"

#include "core/check.hpp"
#include "core/elementary.hpp"
#include "importers/weight_check.hpp"

#include <algorithm>
#include <cmath>

namespace flowslide {
namespace {

constexpr double kNoPressure = 0.01;  // of the largest vertical stress
constexpr double kJump = 0.3;         // allowed change from gravity to the first row
// A node moves at most as far as its speed carries it. It comes back within a step of a second or
// less, so that a small part of the way is seen only; at 10 Hz that is a thirtieth.
constexpr double kTooSlow = 10.0, kTooFast = 100.0;
constexpr double kLongestStep = 1.0;  // [s]
constexpr double kNoWay = 1e-4;       // [m]

}  // namespace

std::vector<std::string> gravity_warnings(const QuadMesh& mesh,
                                          const std::vector<HistoryMaterial>& materials,
                                          const FemFrame& gravity, double unit) {
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
  if (std::string text = weight_warning(mesh, materials, gravity, unit); !text.empty())
    warnings.push_back(std::move(text));
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

MotionWatch::MotionWatch(const QuadMesh& mesh) : mesh_(mesh), strains_(mesh) {
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
  strains_.look_at(frame);
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
  if (std::string text = strains_.warning(); !text.empty()) warnings.push_back(std::move(text));
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
