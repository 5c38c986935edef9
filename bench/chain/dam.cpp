#include "bench/chain/dam.hpp"

#include "core/elementary.hpp"
#include "core/temporary_folder.hpp"
#include "fem/run.hpp"
#include "model/history.hpp"
#include "section/mesh_section.hpp"

#include <cmath>
#include <functional>

/// The Mochikoshi dam of workflows/mochikoshi.yaml in the first seconds of strong shaking, while it
/// liquefies: error against seconds over the size of elements, and what each saving costs.
namespace flowslide {
namespace {

constexpr double kEnd = 3.0;  ///< [s]

/// Elements of a size, and the numbers of them that its blocks need for that.
struct Size {
  double size;      ///< [m]
  int lower;        ///< along the lower dam
  int upper, near;  ///< up the slab of the upper dam, and of the tailings behind it
};
constexpr std::array<Size, 4> kSizes{
    {{8.0, 2, 4, 3}, {5.0, 3, 6, 5}, {3.5, 4, 9, 7}, {2.5, 6, 13, 10}}};
constexpr Size kReference{1.8, 8, 18, 13};
constexpr Size kSavingsAt{3.5, 4, 9, 7};

SectionMesh dam(const Size& s, double left) {
  SectionConfig c;
  c.size = s.size;
  c.size_along_x = {
      {left, s.size + 0.00652 * s.size * (-110.0 - left)}, {-110.0, s.size}, {87.5, s.size}};
  c.materials = {{"embankment", {167}}, {"tailings", {168}}, {"foundation", {170}}};
  c.blocks["foundation"] = {
      {{left, -5}, {87.5, -5}, {87.5, 0}, {left, 0}}, {}, "foundation", {}, {}};
  c.blocks["lower_dam"] = {
      {{0, 0}, {75, 0}, {35.42, 12.5}, {20, 12.5}}, {}, "embankment", {}, {s.lower, 0}};
  c.blocks["upper_dam"] = {{{17.42, 12.5}, {20, 12.5}, {35.42, 12.5}, {-20, 30}, {-38, 30}},
                           {1, 3, 4, 5},
                           "embankment",
                           {},
                           {s.lower + 1, s.upper}};
  c.blocks["tailings_near"] = {{{-70, 0}, {0, 0}, {20, 12.5}, {17.42, 12.5}, {-38, 30}, {-70, 30}},
                               {1, 2, 3, 6},
                               "tailings",
                               {},
                               {0, s.near}};
  c.blocks["tailings_far"] = {{{left, 0}, {-70, 0}, {-70, 30}, {left, 30}}, {}, "tailings", {}, {}};
  c.sets["toe_drain"].line = {{60.8, 0}, {75, 0}};
  return mesh_section(c);
}

FemMaterialConfig material(double density, double void_ratio, std::array<double, 2> permeability,
                           double Dr, double G0, double hpo) {
  FemMaterialConfig m;
  m.density = density;
  m.void_ratio = void_ratio;
  m.permeability = permeability;
  PM4Sand::Params p;
  p.Dr = Dr;
  p.G0 = G0;
  p.hpo = hpo;
  m.laws.of<PM4Sand>() = p;
  return m;
}

FemConfig settings() {
  FemConfig c;
  c.materials["tailings"] = material(1870, 0.99, {7.1e-6, 7.1e-9}, 0.35, 476, 2.70);
  c.materials["tailings"].laws.of<PM4Sand>()->Q = 11.998;
  c.materials["tailings"].laws.of<PM4Sand>()->R = 3.75;
  c.materials["embankment"] = material(1690, 1.20, {1e-6, 1e-6}, 0.55, 677, 0.40);
  c.materials["foundation"] = material(1900, 0.80, {1e-5, 1e-5}, 0.75, 890, 0.63);
  c.water.emplace();
  c.water->table = {{-340, 30}, {-38.2, 30}, {60.8, 0}, {87.5, 0}};
  c.water->drains = {"toe_drain"};
  c.gravity.permeability = 0.01;
  c.gravity.compacts = true;
  c.base.shear_wave_velocity = 550.0;
  c.base.density = 2000.0;
  c.end = kEnd;
  c.output_interval = kEnd;
  return c;
}

/// 0.3 g from the first cycle on; 2.5 Hz is the mean frequency of the workflow's motion.
GroundMotion strong() {
  GroundMotion m{.dt = 0.01, .acceleration = {}, .origin = "sine of 0.3 g"};
  for (int i = 0; i <= std::lround(kEnd / m.dt); ++i) {
    const double t = m.dt * i;
    m.acceleration.push_back(0.3 * kGravity * std::min(1.0, t / 0.4) * sin(5.0 * kPi * t));
  }
  return m;
}

struct Outcome {
  double crest = 0.0;      ///< horizontal displacement of the crest against the base [m]
  double r_u = 0.0;        ///< excess pore pressure over sigma'_v0, mean under the pond
  double liquefied = 0.0;  ///< mean depth of soil with r_u above 0.7 under the pond [m]
  double seconds = 0.0;    ///< of processor
  double elements = 0.0, steps = 0.0, sub_steps = 0.0;
  double iterations = 0.0, most_iterations = 0.0, cut = 0.0;  ///< of implicit steps
  double energy_error = 0.0;
};

Outcome shake(const SectionMesh& mesh, const FemConfig& config) {
  const TemporaryFolder folder;
  const double start = thread_seconds();
  const FemFacts facts =
      run_fem(mesh, strong(), config, {folder / "history.h5", folder / "checkpoint"}, 1, {});
  Outcome r;
  r.seconds = thread_seconds() - start;
  r.steps = static_cast<double>(facts.steps);
  r.sub_steps = facts.sub_steps;
  r.iterations = static_cast<double>(facts.iterations);
  r.most_iterations = facts.most_iterations;
  r.cut = static_cast<double>(facts.cut_steps);
  r.energy_error = facts.energy_error;
  r.elements = static_cast<double>(mesh.mesh.num_elements());
  const FemHistory history(folder / "history.h5");
  const FemFrame end = history.frame(history.times().size() - 1), &rest = history.gravity();
  double base = 0.0, bases = 0.0, nearest = 1e300;
  for (std::size_t i = 0; i < mesh.mesh.num_nodes(); ++i) {
    const auto [x, y] = mesh.mesh.nodes[i];
    const double distance = hypot(x + 20.0, y - 30.0);
    if (distance < nearest) nearest = distance, r.crest = end.displacement[i][0];
    if (y < -5.0 + 1e-9) base += end.displacement[i][0], bases += 1.0;
  }
  r.crest -= base / bases;
  // the pond's window of transfer.zone
  constexpr double kLeft = -70.0, kRight = -50.0, kDepth = 30.0;
  for (std::size_t e = 0; e < mesh.mesh.num_elements(); ++e) {
    const auto xs = corners(mesh.mesh, mesh.mesh.nodes, e);
    const Vec2 c = centroid(xs);
    if (c[0] < kLeft || c[0] > kRight || c[1] < 0.0) continue;
    double pressure = 0.0;
    for (const std::int32_t n : mesh.mesh.elements[e])
      pressure += 0.25 * (end.pore_pressure[n] - rest.pore_pressure[n]);
    const double r_u = -pressure / rest.stress[e][1], depth = area(xs) / (kRight - kLeft);
    r.r_u += r_u * depth / kDepth;
    if (r_u > 0.7) r.liquefied += depth;
  }
  return r;
}

Measurement row(const std::string& name, const Outcome& r, const Outcome& reference) {
  Measurement m;
  m.name = "fem/dam/" + name;
  m.value = std::abs(r.crest / reference.crest - 1.0);
  m.unit = "error of crest";
  m.better = Better::lower;
  m.numbers = {{"elements", r.elements},
               {"steps", r.steps},
               {"sub_steps", r.sub_steps},
               {"crest_m", r.crest},
               {"pond_r_u", r.r_u},
               {"pond_r_u_error", std::abs(r.r_u - reference.r_u)},
               {"liquefied_m", r.liquefied},
               {"core_seconds", r.seconds},
               {"energy_error", r.energy_error}};
  if (r.iterations > 0.0) {
    m.numbers["iterations"] = r.iterations;
    m.numbers["most_iterations"] = r.most_iterations;
    m.numbers["cut_steps"] = r.cut;
  }
  return m;
}

std::vector<Measurement> measure_dam() {
  constexpr double kLeft = -340.0;
  std::vector<Measurement> all;
  const Outcome finest = shake(dam(kReference, kLeft), settings());
  for (const Size& s : kSizes)
    all.push_back(row(fmt::format("size/{:g}", s.size), shake(dam(s, kLeft), settings()), finest));
  all.push_back(row(fmt::format("size/{:g}", kReference.size), finest, finest));
  const auto implicit = [&](const std::string& name, const Size& size, double step) {
    FemConfig c = settings();
    c.integration.scheme = IntegrationScheme::implicit;
    c.integration.step = step;
    all.push_back(row("implicit/" + name, shake(dam(size, kLeft), c), finest));
  };
  for (const Size& s : kSizes) implicit(fmt::format("{:g} m", s.size), s, 5e-3);
  for (const double ms : {20.0, 10.0, 2.5, 1.25})
    implicit(fmt::format("{:g} m, {:g} ms", kSavingsAt.size, ms), kSavingsAt, 1e-3 * ms);

  // Every saving alone, against the same elements with nothing saved.
  const SectionMesh mesh = dam(kSavingsAt, kLeft);
  FemConfig careful = settings();
  careful.courant = 0.1;
  for (auto& [name, m] : careful.materials) {
    m.laws.of<PM4Sand>()->max_strain_increment = 1e-5;
    m.laws.of<PM4Sand>()->tolerance = 1e-6;
  }
  const Outcome exact = shake(mesh, careful);
  const auto with = [&](const std::string& name, const SectionMesh& section,
                        const std::function<void(FemConfig&)>& change) {
    FemConfig c = settings();
    change(c);
    all.push_back(row("saving/" + name, shake(section, c), exact));
  };
  all.push_back(row("saving/none", exact, exact));
  with("default", mesh, [](FemConfig&) {});
  with("courant 0.25", mesh, [](FemConfig& c) { c.courant = 0.25; });
  with("courant 0.9", mesh, [](FemConfig& c) { c.courant = 0.9; });
  const auto strains = [&](double increment, double tolerance) {
    with(fmt::format("increment {:.0e}, tolerance {:.0e}", increment, tolerance), mesh,
         [&](FemConfig& c) {
           for (auto& [name, m] : c.materials) {
             m.laws.of<PM4Sand>()->max_strain_increment = increment;
             m.laws.of<PM4Sand>()->tolerance = tolerance;
           }
         });
  };
  strains(1e-5, 1e-5);
  strains(1.0, 1e-3);
  with("elastic foundation", mesh, [](FemConfig& c) {
    FemMaterialConfig& m = c.materials["foundation"];
    const Elasticity e = PM4Sand::gravity_elasticity(*m.laws.of<PM4Sand>(), 0.3);
    m.laws.of<PM4Sand>().reset();
    m.laws.of<LinearElastic>() = LinearElastic::Params{2.6 * e.shear, 0.3};
  });
  with("drained foundation", mesh, [](FemConfig& c) { c.materials["foundation"].drained = true; });
  with("free field 30 m wide", mesh, [](FemConfig& c) { c.sides.width = 30.0; });
  with("sides fixed", mesh, [](FemConfig& c) { c.sides.kind = SideKind::fixed; });
  with("pond from -200 m", dam(kSavingsAt, -200.0), [](FemConfig&) {});
  return all;
}

}  // namespace

std::vector<BenchCase> dam_benchmarks() {
  return {
      {"fem/dam", "a dam that liquefies: error against seconds, and what is saved", measure_dam}};
}

}  // namespace flowslide
