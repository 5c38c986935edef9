#include "mpm/run/extrude.hpp"

#include "core/check.hpp"
#include "core/memory.hpp"

#include <algorithm>
#include <cmath>

namespace flowslide {
namespace {

/// Beyond these a run takes weeks, and its setting up alone minutes.
constexpr double kMostPoints = 1e7;
/// Of a point among the particles, in the solver and in a stored state, without its grid.
constexpr double kBytesPerPoint = 1000.0;

/// The same array with every entry `copies` times.
template <class T>
std::vector<T> repeated(const std::vector<T>& from, std::size_t copies) {
  std::vector<T> to;
  to.reserve(from.size() * copies);
  for (const T& value : from) to.insert(to.end(), copies, value);
  return to;
}

}  // namespace

ParticleSet extrude(const ParticleSet& section, double width) {
  check(section);
  validate(section.dim == 2,
           "the particles have {} dimensions (a section is extruded) leave "
           "extrude out",
           section.dim);
  validate(section.size() > 0, "there are no particles to extrude");
  double area = 0.0;
  for (const double v : section.volume) area += v;
  const double spacing = std::sqrt(area / double(section.size()));
  const double across = std::max(1.0, std::round(width / spacing));
  validate(across * double(section.size()) <= kMostPoints,
           "extrude.width of {:g} m makes {:.3g} points of {} (at most {:g} are possible) take a "
           "larger cell or a smaller width",
           width, across * double(section.size()), section.size(), kMostPoints);
  need_memory(kBytesPerPoint * across * double(section.size()),
              fmt::format("an extrude.width of {:g} m, {:.3g} points,", width,
                          across * double(section.size())),
              "take a larger cell or a smaller width");
  const auto copies = static_cast<std::size_t>(across);
  const double step = width / across;

  ParticleSet p = section;
  p.dim = 3;
  visit_fields(p, [&](auto, auto, auto& array) { array = repeated(array, copies); });
  for (auto& [name, array] : p.history) array = repeated(array, copies);
  for (std::size_t q = 0; q < p.size(); ++q) {
    const auto slice = static_cast<double>(q % copies);
    const auto up = [](const std::array<double, 3>& v, double y) {
      return std::array<double, 3>{v[0], y, v[1]};
    };
    p.position[q] = up(p.position[q], (slice + 0.5) * step);
    p.velocity[q] = up(p.velocity[q], 0.0);
    p.displacement[q] = up(p.displacement[q], 0.0);
    const std::array<double, 6> s = p.stress[q];
    p.stress[q] = {s[0], s[2], s[1], 0.0, 0.0, s[3]};  // xx yy zz xy yz zx
    p.mass[q] *= step;
    p.volume[q] *= step;
    p.id[q] = p.id[q] * static_cast<std::int64_t>(copies) + static_cast<std::int64_t>(q % copies);
  }
  return p;
}

}  // namespace flowslide
