#include "importers/strain_watch.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace flowslide {
namespace {

using Gradient = std::array<double, 4>;

constexpr std::array<const char*, 3> kNames{"xx", "yy", "xy"};
constexpr std::array<Gradient, 3> kStrains{{{1, 0, 0, 0}, {0, 0, 0, 1}, {0, 1, 1, 0}}};
/// The same of displacements whose components are exchanged.
constexpr std::array<Gradient, 3> kTurned{{{0, 0, 1, 0}, {0, 1, 0, 0}, {1, 0, 0, 1}}};
constexpr std::array<int, 3> kPlaces{0, 1, 3};  // of xx, yy, xy in Voigt notation

// Root mean square of a strain that is more than the rounding of displacements: six digits of 0.1 m
// are 1e-7 of an element of 1 m.
constexpr double kStrained = 1e-5;
constexpr double kOff = 0.1;     // of the square; tensor shear is off by a quarter
constexpr double kSmall = 1e-2;  // square of a strain that hardly is any, over that of the largest
constexpr double kFits = 0.9;    // correlation

/// Slopes of the shape functions at the centre of a quadrilateral.
std::array<Vec2, 4> centre_slopes(const std::array<Vec2, 4>& q) {
  const double ax = q[2][0] - q[0][0], ay = q[2][1] - q[0][1];  // diagonals
  const double bx = q[3][0] - q[1][0], by = q[3][1] - q[1][1];
  const double twice = ax * by - ay * bx;
  return {{{-by / twice, bx / twice},
           {ay / twice, -ax / twice},
           {by / twice, -bx / twice},
           {-ay / twice, ax / twice}}};
}

}  // namespace

StrainWatch::StrainWatch(const QuadMesh& mesh) : mesh_(mesh) {
  for (std::size_t e = 0; e < mesh.num_elements(); ++e)
    slopes_.push_back(centre_slopes(corners(mesh, mesh.nodes, e)));
}

void StrainWatch::look_at(const FemFrame& frame) {
  if (first_strain_.empty()) {
    first_displacement_ = frame.displacement;
    first_strain_ = frame.strain;
    return;
  }
  ++num_states_;
  for (std::size_t e = 0; e < mesh_.num_elements(); ++e) {
    Gradient g{};
    for (std::size_t i = 0; i < 4; ++i) {
      const auto n = static_cast<std::size_t>(mesh_.elements[e][i]);
      for (std::size_t d = 0; d < 2; ++d) {
        const double u = frame.displacement[n][d] - first_displacement_[n][d];
        g[2 * d] += slopes_[e][i][0] * u;
        g[2 * d + 1] += slopes_[e][i][1] * u;
      }
    }
    for (std::size_t j = 0; j < 3; ++j) {
      const double r = frame.strain[e][kPlaces[j]] - first_strain_[e][kPlaces[j]];
      rr_[j] += r * r;
      for (std::size_t k = 0; k < 4; ++k) rg_[j][k] += r * g[k];
    }
    for (std::size_t k = 0; k < 4; ++k)
      for (std::size_t l = 0; l < 4; ++l) gg_[k][l] += g[k] * g[l];
  }
}

double StrainWatch::product(std::size_t recorded, const Gradient& c) const {
  double sum = 0.0;
  for (std::size_t k = 0; k < 4; ++k) sum += rg_[recorded][k] * c[k];
  return sum;
}

double StrainWatch::square(const Gradient& c) const {
  double sum = 0.0;
  for (std::size_t k = 0; k < 4; ++k)
    for (std::size_t l = 0; l < 4; ++l) sum += gg_[k][l] * c[k] * c[l];
  return sum;
}

double StrainWatch::correlation(std::size_t recorded, const Gradient& c) const {
  const double size = std::sqrt(rr_[recorded] * square(c));
  return size > 0.0 ? product(recorded, c) / size : 0.0;
}

/// Whether all three fit displacements with their components exchanged.
bool StrainWatch::turned() const {
  for (std::size_t j = 0; j < 3; ++j)
    if (!(correlation(j, kTurned[j]) > kFits)) return false;
  return true;
}

/// Which strain of the displacements each recorded one follows.
std::string StrainWatch::describe_columns() const {
  std::string text;
  for (std::size_t j = 0; j < 3; ++j) {
    std::size_t best = j;
    for (std::size_t k = 0; k < 3; ++k)
      if (std::abs(correlation(j, kStrains[k])) > std::abs(correlation(j, kStrains[best])) + 0.01)
        best = k;
    const double fit = correlation(j, kStrains[best]);
    text += text.empty() ? "" : "; ";
    if (std::abs(fit) < kFits) {
      text += fmt::format("{} follows none (correlation {:.2g} at best)", kNames[j], fit);
      continue;
    }
    const double factor = product(j, kStrains[best]) / square(kStrains[best]);
    text += fmt::format("{} is {:.3g} times {}", kNames[j], factor, kNames[best]);
  }
  return text;
}

std::string StrainWatch::warning() const {
  std::array<double, 3> size{};
  for (std::size_t j = 0; j < 3; ++j) size[j] = square(kStrains[j]);
  const double strained = *std::ranges::max_element(size);
  const double states = static_cast<double>(mesh_.num_elements() * num_states_);
  if (!(strained > kStrained * kStrained * states)) return {};
  double off = 0.0;
  for (std::size_t j = 0; j < 3; ++j) {
    const double error = rr_[j] - 2.0 * product(j, kStrains[j]) + size[j];
    off = std::max(off, error / std::max(size[j], kSmall * strained));
  }
  if (off <= kOff) return {};
  if (turned())
    return "strain: fits the displacements if their components are exchanged: is "
           "`columns.displacement` [y, x]? The time of transfer and softening hang on both.";
  const double shear = product(2, kStrains[2]) / square(kStrains[2]);
  const bool tensor = correlation(2, kStrains[2]) > kFits && shear > 0.45 && shear < 0.55;
  return fmt::format(
      "strain: does not fit the displacements. Of what they strain the elements since the first "
      "row, {}. {} The time of transfer and softening hang on strains.",
      describe_columns(),
      tensor ? "Half of xy is the tensor's shear strain: record the engineering one, or double it "
               "in the file."
             : "Check the order of `columns.strain`, sign and unit (strains are numbers, not per "
               "cent), and whether both files are of one run.");
}

}  // namespace flowslide
