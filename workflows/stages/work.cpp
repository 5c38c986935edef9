#include "workflows/stages/work.hpp"

#include "core/conventions.hpp"
#include "fem/build_model.hpp"
#include "mpm/kernels/basis.hpp"
#include "mpm/kernels/stress.hpp"
#include "mpm/run/stiffness.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace flowslide {
namespace {

constexpr double kProgram = 30e6;   ///< memory of the program and its libraries [bytes]
constexpr double kStart = 0.05;     ///< to open and close the files of a stage [s]
constexpr double kParallel = 0.95;  ///< of the steps

// Seconds of one thread of an AMD EPYC with AVX-512, and bytes.
constexpr double kPerElement = 1e-5, kBytesPerElement = 4e3;
constexpr double kPerElementStep = 2.1e-7, kBytesPerShakenElement = 30e3;
constexpr double kPerElementFrame = 1e-6;
constexpr double kPerSeededPoint = 1.5e-5, kPerPointStep = 5e-8, kPerPointStep3d = 1.8e-7;
constexpr double kBytesPerPoint = 1.5e3, kBytesPerPoint3d = 2e3;
constexpr double kMotion = 0.1, kReport = 0.1, kDrawing = 6.0, kReportBytes = 100e6;

constexpr double kUsualShaking = 30.0;  ///< of a motion of which nothing is known [s]
constexpr double kOutputInterval = 0.1;
constexpr double kUntilTransfer = 0.7;  ///< of a shaking that ends by the rule of the transfer
constexpr double kSaturatedWave = 700.0, kDryWave = 250.0;  ///< of soil under a dam [m/s]
constexpr double kTimesOfFall = 35.0;                       ///< sqrt(H/g) until a slide is at rest

/// Smallest height of an element: its area over its longest side.
double smallest_height(const QuadMesh& mesh) {
  double least = std::numeric_limits<double>::infinity();
  for (const auto& nodes : mesh.elements) {
    double twice_area = 0.0, longest = 0.0;
    for (std::size_t k = 0; k < nodes.size(); ++k) {
      const Vec2 &a = mesh.nodes[nodes[k]], &b = mesh.nodes[nodes[(k + 1) % nodes.size()]];
      twice_area += a[0] * b[1] - b[0] * a[1];
      const double dx = b[0] - a[0], dy = b[1] - a[1];
      longest = std::max(longest, std::sqrt(dx * dx + dy * dy));
    }
    if (longest > 0.0) least = std::min(least, 0.5 * std::abs(twice_area) / longest);
  }
  return least;
}

/// As in docs/theory/fem.md, (soil + water) dt^2/4 + beta soil dt/2 = 1 with squared frequencies of
/// waves across the height of an element.
double stable_step(double height, const FemDampingConfig& damping) {
  const double undamped = height / kSaturatedWave, dry = 2.0 * kDryWave / height;
  const double most = damping.largest_ratio ? 2.0 * *damping.largest_ratio / dry
                                            : std::numeric_limits<double>::infinity();
  const double a = 0.25 * std::min(fem::rayleigh(damping).stiffness, most) * dry * dry;
  return 1.0 / (a + std::sqrt(a * a + 1.0 / (undamped * undamped)));
}

double elements_of(const QuadMesh& mesh) { return static_cast<double>(mesh.elements.size()); }

double seeded_points(const MapConfig& map, const Soil& soil) {
  if (map.seeding == Seeding::gauss) return 4.0 * static_cast<double>(soil.centres.size());
  const double per_metre = map.points_per_cell / map.cell;
  return soil.area * per_metre * per_metre;
}

double fastest_wave(const FlowConfig& flow, const MapConfig& map,
                    const std::vector<HistoryMaterial>& materials, const Soil& soil) {
  double most2 = 0.0;
  double lowest = soil.all.bottom;
  for (const auto& point : flow.ground.surface) lowest = std::min(lowest, point[1]);
  const double fall = soil.all.top - lowest;
  const auto wave2 = [&](double youngs_modulus, double poisson_ratio, double density) {
    Elasticity e = Elasticity::from_young(youngs_modulus, poisson_ratio);
    if (flow.stiffness == Stiffness::automatic)
      e = no_stiffer(e,
                     needed_bulk(flow.stiffness_bounds, density, density * flow.gravity * fall,
                                 fall_speed(flow.gravity, fall)),
                     0.0);
    return mpm::wave_modulus<2>(e, true, flow.basis) / density;
  };
  for (const auto& [name, m] : map.materials) {
    double density = std::numeric_limits<double>::infinity();
    for (const std::string& source : sources_of(name, m))
      density = std::min(density, find_material(materials, source, name).density);
    const LawParameters law = to_parameters(make_material(m.law, name));
    const auto young = law.parameters.find("youngs_modulus");
    const auto poisson = law.parameters.find("poisson_ratio");
    if (young != law.parameters.end() && poisson != law.parameters.end())
      most2 = std::max(most2, wave2(young->second, poisson->second, density));
    if (m.liquefied)
      most2 =
          std::max(most2, wave2(m.liquefied->youngs_modulus, m.liquefied->poisson_ratio, density));
  }
  return std::sqrt(most2);
}

}  // namespace

Work mesh_work(const QuadMesh& mesh) {
  return {.seconds = kStart + kPerElement * elements_of(mesh),
          .parallel = 0.0,
          .memory = kProgram + kBytesPerElement * elements_of(mesh)};
}

Work shaking_work(const FemConfig& config, const QuadMesh& mesh, std::optional<double> until,
                  bool stops_at_transfer) {
  const double end = until.value_or(kUsualShaking) * (stops_at_transfer ? kUntilTransfer : 1.0);
  const double step = config.courant * stable_step(smallest_height(mesh), config.damping);
  return {.seconds = kStart + kPerElementStep * elements_of(mesh) * end / step,
          .parallel = kParallel,
          .memory = kProgram + kBytesPerShakenElement * elements_of(mesh)};
}

Work zone_work(const QuadMesh& mesh, bool shakes, std::optional<double> end) {
  const double frames = shakes ? end.value_or(kUsualShaking) / kOutputInterval : 1.0;
  return {.seconds = kStart + kPerElementFrame * elements_of(mesh) * frames,
          .parallel = 0.0,
          .memory = kProgram + kBytesPerElement * elements_of(mesh)};
}

Work map_work(const MapConfig& map, const Soil& soil) {
  const double points = seeded_points(map, soil);
  return {.seconds = kStart + kPerSeededPoint * points,
          .parallel = 0.0,
          .memory = kProgram + kBytesPerPoint * points};
}

Work flow_work(const FlowConfig& flow, const MapConfig& map,
               const std::vector<HistoryMaterial>& materials, const Soil& soil) {
  if (soil.counted.empty()) return {};
  const double wave = fastest_wave(flow, map, materials, soil);
  if (!(wave > 0.0)) return {};
  const bool plane = !flow.extrude;
  const double across = plane ? 1.0 : flow.extrude->width * map.points_per_cell / map.cell;
  const double points = seeded_points(map, soil) * across;
  const double rest = kTimesOfFall * std::sqrt(soil.counted.height() / kGravity);
  const double cells = plane ? mpm::stable_cells<2>(flow) : mpm::stable_cells<3>(flow);
  const double step = cells * flow.cell / wave * flow.courant;
  return {.seconds = kStart + (plane ? kPerPointStep : kPerPointStep3d) * points *
                                  std::min(flow.end, rest) / step,
          .parallel = kParallel,
          .memory = kProgram + (plane ? kBytesPerPoint : kBytesPerPoint3d) * points};
}

Work motion_work() { return {.seconds = kMotion, .parallel = 0.0, .memory = kProgram}; }

Work report_work(const ReportConfig& config) {
  return {.seconds = kReport + (config.figures ? kDrawing : 0.0),
          .parallel = 0.0,
          .memory = kReportBytes};
}

}  // namespace flowslide
