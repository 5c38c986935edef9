#include "core/conventions.hpp"
#include "fem/build_model.hpp"
#include "workflows/stages/cross_checks.hpp"

#include <algorithm>
#include <cmath>

/// Whether the mesh carries the waves of the motion, and what the soil at rest says of its
/// stiffness.
namespace flowslide {
namespace {

/// Shear modulus under a mean effective stress [Pa].
double shear_modulus(const FemMaterialConfig& m, double mean_stress) {
  double shear = 0.0;
  ShakingLaws::each([&]<class M>() {
    const auto& law = m.laws.of<M>();
    if (!law) return;
    if constexpr (std::is_same_v<M, PM4Sand>) {
      const double least = law->P_atm / 200.0;  // as the law itself
      shear = law->G0 * std::sqrt(law->P_atm * std::max(mean_stress, least));
    } else {
      shear = M::elasticity(*law).shear;
    }
  });
  return shear;
}

/// Height of the polyline of outer edges above x; unset beside it.
double surface_above(const SectionMesh& section, const EdgeSet& surface, double x) {
  double top = kUnset;
  for (const auto& edge : surface.edges) {
    const Vec2 &a = section.mesh.nodes[edge[0]], &b = section.mesh.nodes[edge[1]];
    if (x < std::min(a[0], b[0]) || x > std::max(a[0], b[0])) continue;
    const double y =
        a[0] == b[0] ? std::max(a[1], b[1]) : a[1] + (x - a[0]) / (b[0] - a[0]) * (b[1] - a[1]);
    if (!(top >= y)) top = y;
  }
  return top;
}

/// An element as a wave meets it.
struct Passed {
  std::size_t element = 0;
  Vec2 centre{};
  double width = 0.0, height = 0.0;  ///< [m]
  double speed = 0.0;                ///< of shear waves at rest [m/s]
};

/// As level ground would be at rest: the soil above weighs on the element, with its own density.
double speed_at_rest(const FemConfig& fem, const FemMaterialConfig& m, Vec2 at, double surface) {
  double vertical = m.density * kGravity * (surface - at[1]);
  if (fem.water && !fem.water->table.empty()) {
    const double level = fem::water_level(*fem.water, at[0]);
    const double unit_weight = fem.water->density * kGravity;
    vertical += unit_weight * (std::max(0.0, level - surface) - std::max(0.0, level - at[1]));
  }
  const double mean = 0.5 * (1.0 + m.k0) * std::max(vertical, 0.0);
  return std::sqrt(shear_modulus(m, mean) / m.density);
}

std::vector<Passed> passed_elements(const FemConfig& fem, const SectionMesh& section) {
  std::map<std::int32_t, const FemMaterialConfig*> materials;
  for (const MaterialName& name : section.materials)
    if (const auto at = fem.materials.find(name.name); at != fem.materials.end())
      materials[name.tag] = &at->second;
  const EdgeSet& surface = find_set(section, "surface");
  std::vector<Passed> all;
  for (std::size_t e = 0; e < section.mesh.num_elements(); ++e) {
    const auto m = materials.find(section.mesh.element_material[e]);
    if (m == materials.end()) continue;
    Passed p{.element = e, .centre = {}, .width = 0.0, .height = 0.0, .speed = 0.0};
    const auto quad = corners(section.mesh, section.mesh.nodes, e);
    p.centre = centroid(quad);
    const double top = surface_above(section, surface, p.centre[0]);
    if (!is_set(top)) continue;
    const auto [left, right] = std::minmax({quad[0][0], quad[1][0], quad[2][0], quad[3][0]});
    p.width = right - left;
    p.height = area(quad) / p.width;
    p.speed = speed_at_rest(fem, *m->second, p.centre, top);
    all.push_back(p);
  }
  return all;
}

/// Elements one above the other under the highest ground.
int rows_of(const QuadMesh& mesh) {
  const auto top = std::ranges::max_element(mesh.nodes, {}, [](const Vec2& p) { return p[1]; });
  const Extent all = extent_of(mesh);
  // Beside the node, which is a corner of all its elements, on the side where there is soil.
  const double aside = 1e-4 * (all.right - all.left);
  int most = 0;
  for (const double x : {(*top)[0] - aside, (*top)[0] + aside}) {
    int rows = 0;
    for (std::size_t e = 0; e < mesh.num_elements(); ++e) {
      const auto quad = corners(mesh, mesh.nodes, e);
      const auto [left, right] = std::minmax({quad[0][0], quad[1][0], quad[2][0], quad[3][0]});
      rows += x > left && x < right;
    }
    most = std::max(most, rows);
  }
  return most;
}

void check_rows(const QuadMesh& mesh, Findings& found) {
  constexpr int kFewest = 4;
  const int rows = rows_of(mesh);
  const double height = extent_of(mesh).height();
  if (rows < kFewest)
    warn(found,
         "the mesh has {} element{} over the height of the section of {:.3g} m: where it shears, "
         "and how deep it liquefies, is a matter of single elements. Take elements of {:.2g} m or "
         "less, and compare with half of that.",
         rows, rows == 1 ? "" : "s", height, height / (2 * kFewest));
}

/// Warns of the worst of those elements that have too few in a wave.
void warn_of_waves(const std::vector<Passed>& all, double Passed::*size, double frequency,
                   double fewest, const char* what, const char* which, const SectionMesh& section,
                   Findings& found) {
  constexpr double kMany = 0.1;  // of the area of the section
  double coarse = 0.0, whole = 0.0, least = std::numeric_limits<double>::infinity();
  const Passed* worst = nullptr;
  std::size_t count = 0;
  for (const Passed& p : all) {
    const double in_wave = p.speed / frequency / (p.*size);
    whole += p.width * p.height;
    if (in_wave >= fewest) continue;
    ++count;
    coarse += p.width * p.height;
    if (in_wave >= least) continue;
    least = in_wave;
    worst = &p;
  }
  if (coarse <= kMany * whole) return;
  warn(found,
       "{} of {} elements are too {} for the motion: {} {:.2g} Hz, a wave length of {:.3g} m in "
       "element {} at ({:.6g}, {:.6g}) m, where shear waves go with {:.0f} m/s. It is {:.3g} m {}, "
       "{:.2g} elements in a wave, and with fewer than {:g} the shaking that passes is not that of "
       "the motion. Take {:.2g} m or less.",
       count, all.size(), what, which, frequency, worst->speed / frequency,
       section.mesh.element_tags[worst->element], worst->centre[0], worst->centre[1], worst->speed,
       (*worst).*size, what, least, fewest, worst->speed / frequency / fewest);
}

}  // namespace

void check_waves(const FemConfig& fem, const SectionMesh& section, const MotionBand& band,
                 Findings& found) {
  check_rows(section.mesh, found);
  const std::vector<Passed> all = passed_elements(fem, section);
  if (all.empty()) return;
  // Between pi elements, where a lumped mesh carries nothing, and the 8 to 10 that are usual, with
  // which waves are 1 to 3 % too slow; with 4 they are 10 % too slow.
  constexpr double kOverHeight = 4.0, kAlong = 3.2;
  if (band.highest)
    warn_of_waves(all, &Passed::height, *band.highest, kOverHeight, "high",
                  "four fifths of its energy lie below", section, found);
  if (band.mean_period)
    warn_of_waves(all, &Passed::width, 1.0 / *band.mean_period, kAlong, "long", "its mean is",
                  section, found);
  if (!fem.base.shear_wave_velocity) return;
  const double rock = *fem.base.shear_wave_velocity;
  const auto stiff = std::ranges::max_element(all, {}, &Passed::speed);
  if (stiff->speed > rock)
    warn(found,
         "base.shear_wave_velocity: {:g} m/s is less than that of the soil on it, {:.0f} m/s in "
         "element {} at ({:.6g}, {:.6g}) m: waves would leave into the base as into a softer soil. "
         "Is it that of the rock, in m/s, and is the stiffness of the soil right?",
         rock, stiff->speed, section.mesh.element_tags[stiff->element], stiff->centre[0],
         stiff->centre[1]);
}

}  // namespace flowslide
