#include "importers/weight_check.hpp"

#include "core/conventions.hpp"
#include "core/median.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

namespace flowslide {
namespace {

constexpr std::size_t kSamples = 200;
// Slopes carry a little of their weight to the side: a dam comes to 0.9996 in the median.
constexpr double kLow = 0.88, kHigh = 1.14;
constexpr double kNear = 1.12;  // a guess fits within this factor

/// An element, what weighs on its centre, and its stress.
struct Column {
  double depth = 0.0;     ///< [m]
  double weight = 0.0;    ///< of the soil above [Pa]
  double pressure = 0.0;  ///< of the pores [Pa]
  double pond = 0.0;      ///< of water on the surface [Pa]
  Stress<2> stress{};
};

/// Where the vertical line through x cuts an element.
struct Cut {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  double pressure = 0.0;  ///< at the upper end
};

Cut cut_at(const QuadMesh& mesh, const FemFrame& gravity, std::size_t e, double x) {
  Cut cut;
  for (std::size_t i = 0; i < 4; ++i) {
    const auto a = static_cast<std::size_t>(mesh.elements[e][i]);
    const auto b = static_cast<std::size_t>(mesh.elements[e][(i + 1) % 4]);
    const Vec2 &p = mesh.nodes[a], &q = mesh.nodes[b];
    if (p[0] == q[0] || x < std::min(p[0], q[0]) || x > std::max(p[0], q[0])) continue;
    const double s = (x - p[0]) / (q[0] - p[0]), y = p[1] + s * (q[1] - p[1]);
    cut.low = std::min(cut.low, y);
    if (y <= cut.high) continue;
    cut.high = y;
    cut.pressure = (1.0 - s) * gravity.pore_pressure[a] + s * gravity.pore_pressure[b];
  }
  return cut;
}

Column column_above(const QuadMesh& mesh, const std::vector<double>& density,
                    const FemFrame& gravity, std::size_t element) {
  const Vec2 at = centroid(corners(mesh, mesh.nodes, element));
  Column c;
  c.stress = gravity.stress[element];
  for (const std::int32_t n : mesh.elements[element])
    c.pressure += 0.25 * gravity.pore_pressure[static_cast<std::size_t>(n)];
  double top = at[1];
  for (std::size_t e = 0; e < mesh.num_elements(); ++e) {
    const Cut cut = cut_at(mesh, gravity, e, at[0]);
    if (!(cut.high > at[1])) continue;
    c.weight += density[e] * kGravity * (cut.high - std::max(cut.low, at[1]));
    if (cut.high <= top) continue;
    top = cut.high;
    c.pond = cut.pressure;
  }
  c.depth = top - at[1];
  if (!(c.pond * c.pressure > 0.0)) c.pond = 0.0;  // suction at the surface is no weight
  return c;
}

/// A way to read the files, and the median of total stress over weight that it gives.
struct Reading {
  const char* text;
  double stress, pressure;  ///< factors
  int component;
};
constexpr Reading kAsRead{"", -1.0, 1.0, 1};
constexpr std::array kOthers{
    Reading{"the sign of the pore pressure is changed (compression is positive)", -1.0, -1.0, 1},
    Reading{"the sign of the stress is changed (tension is positive)", 1.0, 1.0, 1},
    Reading{"the signs of stress and pore pressure are changed", 1.0, -1.0, 1},
    Reading{"the stress is a total one: the pore pressure is in it already", -1.0, 0.0, 1},
    Reading{"the stress that is read as xx is the vertical one (`columns.stress`)", -1.0, 1.0, 0},
    Reading{"the stress that is read as xy is the vertical one (`columns.stress`)", -1.0, 1.0, 3}};

/// Total stress over weight, and how far it differs between elements.
struct Ratio {
  double median = 0.0;
  double spread = 0.0;  ///< median distance from the median, relative to it
};

Ratio ratio_of(const std::vector<Column>& columns, const Reading& r) {
  std::vector<double> ratios;
  for (const Column& c : columns)
    ratios.push_back((r.stress * c.stress[r.component] + r.pressure * c.pressure -
                      (r.pressure < 0.0 ? -c.pond : c.pond)) /
                     c.weight);
  const double middle = median(ratios);
  for (double& v : ratios) v = std::abs(v - middle);
  return {middle, median(std::move(ratios)) / std::abs(middle)};
}

bool fits(double ratio) { return ratio > 1.0 / kNear && ratio < kNear; }

/// What would explain the ratio, and how well it does in each element.
struct Guess {
  std::string text;
  double spread = 0.0;
};

struct Unit {
  const char* name;
  double pascal;
};
constexpr std::array kUnits{Unit{"Pa", 1.0},      Unit{"kPa", 1e3},      Unit{"MPa", 1e6},
                            Unit{"bar", 1e5},     Unit{"t/m2", 9806.65}, Unit{"psi", 6894.76},
                            Unit{"psf", 47.8803}, Unit{"ksf", 47880.3}};

std::string guesses(const std::vector<Column>& columns, const Ratio& found, double unit) {
  const double ratio = found.median;
  std::vector<Guess> all;
  for (const Unit& u : kUnits)
    if (u.pascal != unit && ratio > 0.0 && fits(ratio * u.pascal / unit))
      all.push_back({fmt::format("`units.stress` is {}", u.name), found.spread});
  if (ratio > 0.3 && ratio < 3.0)
    all.push_back(
        {fmt::format("the densities of `materials`, of grains and water together, are {:.2f} times "
                     "those given",
                     ratio),
         found.spread});
  for (const Reading& other : kOthers) {
    const Ratio r = ratio_of(columns, other);
    if (fits(r.median))
      all.push_back({fmt::format("{} ({:.2f} times)", other.text, r.median), r.spread});
  }
  if (all.empty())
    return "Are `units.stress` and `units.length`, the order of the recorders, `columns.stress`, "
           "the gravity row and the densities right?";
  // What fits in the median alone, by chance, differs from element to element.
  std::stable_sort(all.begin(), all.end(),
                   [](const Guess& a, const Guess& b) { return a.spread < b.spread; });
  const double most = 3.0 * all.front().spread + 0.02;
  std::vector<std::string> words;
  for (const Guess& g : all)
    if (g.spread <= most) words.push_back(g.text);
  return fmt::format("It would fit if {}.", fmt::join(words, ", or if "));
}

}  // namespace

std::string weight_warning(const QuadMesh& mesh, const std::vector<HistoryMaterial>& materials,
                           const FemFrame& gravity, double unit) {
  const std::vector<double> density = element_densities(mesh, materials);
  std::vector<Column> columns;
  const std::size_t stride = std::max<std::size_t>(1, mesh.num_elements() / kSamples);
  for (std::size_t e = 0; e < mesh.num_elements(); e += stride)
    columns.push_back(column_above(mesh, density, gravity, e));
  double deepest = 0.0;
  for (const Column& c : columns) deepest = std::max(deepest, c.depth);
  std::erase_if(columns, [&](const Column& c) { return !(c.depth > deepest / 3.0); });
  const Ratio ratio = ratio_of(columns, kAsRead);
  if (ratio.median >= kLow && ratio.median <= kHigh) return {};
  return fmt::format(
      "gravity: the total vertical stress (pore pressure less effective stress) is {:.3g} times "
      "the weight of the soil above, density by thickness, in the median of {} elements below a "
      "third of the depth: the soil is not at rest under its own weight. {}",
      ratio.median, columns.size(), guesses(columns, ratio, unit));
}

}  // namespace flowslide
