#include "bench/mpm/bandwidth.hpp"
#include "bench/mpm/named_transfer.hpp"
#include "bench/mpm/speed.hpp"
#include "core/check.hpp"
#include "core/conventions.hpp"
#include "core/elementary.hpp"
#include "mpm/run/load.hpp"

#include <cmath>
#include <optional>
#include <utility>

namespace flowslide::mpm {
namespace {

/// A free elastic bar (nu = 0) that swings in its first mode while it moves through the grid. The
/// motion is exact for every scheme, so the error is that of the swing alone, with points that
/// cross cells all the time.
struct Bar {
  static constexpr double length = 10.0, width = 1.0;  ///< [m]
  static constexpr double young = 1e6, density = 1000.0;
  static constexpr double amplitude = 3e-3;        ///< [m/s]: strain 1e-4, linear to that order
  static constexpr double across[2] = {5.0, 2.0};  ///< velocity of the whole [m/s]
  static double period() { return 2.0 * length * std::sqrt(density / young); }
};

ParticleSet bar(double spacing) {
  ParticleSet p;
  p.materials = {
      {"bar", "linear_elastic", {{"youngs_modulus", Bar::young}, {"poisson_ratio", 0.0}}, true}};
  const auto nx = static_cast<std::size_t>(std::lround(Bar::length / spacing));
  const auto ny = static_cast<std::size_t>(std::lround(Bar::width / spacing));
  resize(p, nx * ny);
  for (std::size_t q = 0; q < p.size(); ++q) {
    const std::size_t row = q / nx;
    p.position[q] = {(double(q % nx) + 0.5) * spacing, (double(row) + 0.5) * spacing, 0.0};
    p.velocity[q] = {Bar::across[0] + Bar::amplitude * cos(kPi * p.position[q][0] / Bar::length),
                     Bar::across[1], 0.0};
    p.volume[q] = spacing * spacing;
    p.mass[q] = Bar::density * p.volume[q];
    p.material[q] = 0;
    p.id[q] = static_cast<std::int64_t>(q) + 1;
  }
  return p;
}

/// After one period the velocity is that of the start. Nothing where the numerics fail before.
std::optional<Measurement> point_of_line(BasisKind basis, std::string_view basis_name,
                                         const NamedTransfer& line, double cell) {
  const ParticleSet p = bar(0.5 * cell);
  FlowConfig c;
  c.cell = cell;
  c.end = 1.0;
  c.gravity = 0.0;
  c.ground.surface = {{0.0, -1e6}};
  c.basis = basis;
  c.transfer = line.transfer;
  c.flip_share = 0.99;
  c.fmpm_order = 2;
  Simulation<2> s = make_simulation(p, c);
  StepScratch<2> scratch(1);
  prepare(s, scratch, true);
  const double start = thread_seconds();
  const double end = Bar::period();
  try {
    while (s.time < end) {
      // The last step ends at the period.
      const double left = end - s.time, dt = stable_step(s);
      s.settings.courant = c.courant * std::min(1.0, left / dt);
      advance(s, scratch);
      s.settings.courant = c.courant;
      if (left < 1e-9 * end) break;
    }
  } catch (const NumericsError&) {
    return {};
  }
  Measurement m;
  m.numbers["core_seconds"] = thread_seconds() - start;
  m.numbers["cell_m"] = cell;
  m.numbers["points"] = double(p.size());
  m.numbers["steps"] = double(s.step);
  double sum = 0.0, scale = 0.0;
  for (std::size_t q = 0; q < p.size(); ++q) {
    for (int d = 0; d < 2; ++d) {
      const double error = s.points.v[d][q] - p.velocity[s.points.index[q]][d];
      const double swing = p.velocity[s.points.index[q]][d] - Bar::across[d];
      sum += error * error;
      scale += swing * swing;
    }
  }
  m.name = fmt::format("mpm/curve/{}/{}/{:g}", basis_name, line.name, cell);
  m.value = std::sqrt(sum / scale);
  m.unit = "rms error of velocity";
  m.better = Better::lower;
  return m;
}

}  // namespace

std::vector<Measurement> work_precision() {
  constexpr NamedTransfer lines[] = {{"apic", Transfer::apic},   {"tpic", Transfer::tpic},
                                     {"aflip", Transfer::aflip}, {"flip_0.99", Transfer::flip},
                                     {"pic", Transfer::pic},     {"fmpm_2", Transfer::fmpm}};
  std::vector<Measurement> all;
  for (const BasisKind basis : {BasisKind::linear, BasisKind::gimp, BasisKind::quadratic,
                                BasisKind::mls, BasisKind::cubic}) {
    const std::string_view name =
        visit_basis(basis, []<class B>(B) { return std::string_view(B::name); });
    for (const NamedTransfer& line : lines)
      for (const double cell : {1.0, 0.5, 0.25, 0.125})
        if (auto point = point_of_line(basis, name, line, cell)) all.push_back(*std::move(point));
  }
  return all;
}

}  // namespace flowslide::mpm
