#include "transfer/sordo2024/compat_sordo2024_material.hpp"

#include "constitutive/materials.hpp"
#include "core/conventions.hpp"
#include "core/elementary.hpp"

#include <algorithm>
#include <cmath>

namespace flowslide {
namespace {

constexpr double kScriptPi = 3.14159;  // cut short as there (S16)

bool is_liquefied(const SordoConfig& c, const SordoPoint& p) {
  if (p.element_material != c.tailings) return false;
  if (c.liquefied == SordoLiquefied::all || p.r_u > c.r_u) return true;
  const double slope = (c.line[1][1] - c.line[0][1]) / (c.line[1][0] - c.line[0][0]);
  const double level = c.line[0][1] - slope * c.line[0][0];
  return (p.x[0] < c.line[0][0] && p.x[1] > c.line[0][1]) ||
         (p.x[0] > c.line[0][0] && p.x[1] > slope * p.x[0] + level);
}

}  // namespace

const std::vector<double>* find_row(const std::vector<std::vector<double>>& rows, int tag) {
  const auto it = std::find_if(rows.begin(), rows.end(),
                               [tag](const std::vector<double>& row) { return row[0] == tag; });
  return it == rows.end() ? nullptr : &*it;
}

std::optional<int> sordo_runout_tag(const SordoConfig& c, const SordoPoint& p) {
  if (is_liquefied(c, p)) {
    for (std::size_t i = 1; i < c.layers.size(); ++i) {
      if (p.sigma_v > -c.layers[i][0]) return static_cast<int>(c.layers[i - 1][1]);
    }
    if (c.layers.size() > 1 && !(p.sigma_v < -c.layers.back()[0])) return std::nullopt;
    return static_cast<int>(c.layers.back()[1]);
  }
  // y stands on both sides, where x is surely meant (S04).
  if (p.element_material == c.embankment && p.x[1] < c.water_slope * p.x[1] + c.water_level)
    return c.saturated_embankment;
  return p.element_material;
}

std::array<double, 2> sordo_softened(const SordoConfig& c, int tag, double eps_q) {
  const std::vector<double>* row = find_row(c.strengths, tag);
  if (row == nullptr) return {0.0, 0.0};
  const std::vector<double>& r = *row;
  const double degree = std::clamp((eps_q - r[5]) / (r[6] - r[5]), 0.0, 1.0);
  const double phi = r[1] + (r[2] - r[1]) * degree;
  return {tan(phi * (kScriptPi / kPi)), r[3] + (r[4] - r[3]) * degree};
}

MaterialSpec sordo_material(const SordoConfig& c, int tag) {
  if (tag == c.foundation) {
    const LinearElastic::Params p{c.youngs_modulus, c.poisson_ratio};
    const LawParameters law = to_parameters(Material<LinearElastic>{p});
    return {fmt::format("foundation {}", tag), law.law, law.parameters, false};
  }
  const std::vector<double>* row = find_row(c.strengths, tag);
  validate(row != nullptr,
           "strengths has no row for material {} (points of it take part in the runout) "
           "add one",
           tag);
  MohrCoulomb::Params p;
  p.youngs_modulus = c.youngs_modulus;
  p.poisson_ratio = c.poisson_ratio;
  p.friction_angle = (*row)[1];
  p.residual_friction_angle = (*row)[2];
  p.cohesion = (*row)[3];
  p.residual_cohesion = (*row)[4];
  p.peak_strain = (*row)[5];
  p.residual_strain = (*row)[6];
  const LawParameters law = to_parameters(Material<MohrCoulomb>{p});
  const bool layer = std::any_of(c.layers.begin(), c.layers.end(),
                                 [tag](const std::vector<double>& l) { return l[1] == tag; });
  const std::string_view what = layer ? "liquefied" : tag == c.tailings ? "tailings" : "embankment";
  return {fmt::format("{} {}", what, tag), law.law, law.parameters, true, layer};
}

}  // namespace flowslide
