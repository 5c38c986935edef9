#include "transfer/map/map_state.hpp"

#include "config/yaml.hpp"
#include "core/conventions.hpp"
#include "distorted_mesh.hpp"
#include "tests/support/scratch.hpp"
#include "transfer/sordo2024/map_sordo2024.hpp"

#include <cmath>
#include <filesystem>
#include <fstream>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

using namespace flowslide;
using flowslide::test::distorted_mesh;

namespace {

constexpr double kDensity = 1900.0;
constexpr double kHeight = 12.0;

/// Level ground, saturated, water table at the surface, K0 by material tag.
FemFrame geostatic(const QuadMesh& mesh, double k0_tag_1 = 0.5, double k0_tag_2 = 0.5) {
  FemFrame f;
  f.displacement.resize(mesh.num_nodes());
  f.velocity.resize(mesh.num_nodes());
  for (const Vec2& x : mesh.nodes) f.pore_pressure.push_back(1000.0 * kGravity * (kHeight - x[1]));
  for (std::size_t e = 0; e < mesh.num_elements(); ++e) {
    const double y = centroid(corners(mesh, mesh.nodes, e))[1];
    const double v = -(kDensity - 1000.0) * kGravity * (kHeight - y);
    const double k0 = mesh.element_material[e] == 1 ? k0_tag_1 : k0_tag_2;
    f.stress.push_back({{k0 * v, v, k0 * v, 0.0}});
    f.strain.push_back({});
  }
  return f;
}

LiquefactionZone dry_zone(const QuadMesh& mesh) {
  LiquefactionZone z;
  z.liquefied.assign(mesh.num_elements(), 0);
  z.strength.assign(mesh.num_elements(), kUnset);
  z.r_u_node.assign(mesh.num_nodes(), 0.25);
  z.r_u_element.assign(mesh.num_elements(), 0.25);
  return z;
}

const std::vector<HistoryMaterial> kSoils{
    {"tailings", 1, kDensity}, {"dam", 2, kDensity}, {"rock", 99, 2500.0}};

MapResult map_state(const QuadMesh& mesh, const FemFrame& gravity, const FemFrame* shaking,
                    const LiquefactionZone& zone, const MapConfig& c) {
  return map_state(mesh, kSoils, gravity, shaking, zone, c);
}

MapMaterial soil() {
  MapMaterial m;
  m.law.of<MohrCoulomb>().emplace();
  m.law.of<MohrCoulomb>()->youngs_modulus = 20e6;
  m.law.of<MohrCoulomb>()->poisson_ratio = 0.3;
  m.law.of<MohrCoulomb>()->cohesion = 1e3;
  m.law.of<MohrCoulomb>()->friction_angle = 0.61;
  m.liquefied.emplace();
  m.liquefied->youngs_modulus = 5e6;
  m.liquefied->poisson_ratio = 0.49;
  return m;
}

MapConfig config() {
  MapConfig c;
  c.cell = 1.0;
  c.c_soft_ratio = 0.5;
  c.materials = {{"tailings", soil()}, {"dam", soil()}};
  c.audit.out_of_balance_rms = 0.01;
  c.audit.out_of_balance_max = 0.1;
  return c;
}

QuadMesh ground(double distortion, std::uint64_t seed = 1) {
  return distorted_mesh(24, 12, 0.0, 24.0, kHeight, distortion, seed);
}

const AuditCheck& check_of(const TransferAudit& audit, const std::string& name) {
  for (const AuditCheck& c : audit.checks)
    if (c.name == name) return c;
  throw std::logic_error("no check " + name);
}

}  // namespace

TEST_CASE("Geostatic ground is handed over at rest by the lattice, not by Gauss points",
          "[transfer]") {
  const QuadMesh mesh = ground(0.15);
  const FemFrame gravity = geostatic(mesh);
  for (const Vec2 origin : {Vec2{0.0, 0.0}, Vec2{0.37, 0.81}}) {
    MapConfig c = config();
    c.grid_origin = origin;
    const MapResult lattice = map_state(mesh, gravity, nullptr, dry_zone(mesh), c);
    CHECK(lattice.audit.passed());
    CHECK(lattice.audit.mapped.nodes > 100);
    CHECK(lattice.audit.returned.rms < 0.01);
    CHECK(check_of(lattice.audit, "mass").error < 1e-12);
    CHECK(check_of(lattice.audit, "volume").error < 1e-12);

    c.seeding = Seeding::gauss;
    c.audit.enforce = false;
    const MapResult gauss = map_state(mesh, gravity, nullptr, dry_zone(mesh), c);
    CHECK(gauss.audit.mapped.nodes > 100);
    CHECK(gauss.audit.mapped.rms > 10.0 * std::max(lattice.audit.mapped.rms, 1e-3));
    CHECK_FALSE(gauss.audit.passed());
    CHECK(check_of(gauss.audit, "mass").error < 1e-12);
  }
}

TEST_CASE("Both stresses that may be interpolated give total = effective - u", "[transfer]") {
  const QuadMesh mesh = ground(0.2);
  const FemFrame gravity = geostatic(mesh);
  for (const MappedStress what : {MappedStress::total, MappedStress::effective}) {
    MapConfig c = config();
    c.mapped_stress = what;
    c.audit.enforce = false;
    const ParticleSet p = map_state(mesh, gravity, nullptr, dry_zone(mesh), c).particles;
    double worst = 0.0;
    for (std::size_t i = 0; i < p.size(); ++i) {
      const double depth = kHeight - p.position[i][1];
      worst = std::max(worst, std::abs(p.stress[i][1] + kDensity * kGravity * depth));
      CHECK(p.pore_pressure[i] == Approx(1000.0 * kGravity * depth).epsilon(1e-9));
    }
    // The mean of four corners is u at the centroid only to second order of the distortion.
    CHECK(worst <
          1e-3 * kDensity * kGravity * kHeight * (what == MappedStress::total ? 1.0 : 1e-6));
  }
}

TEST_CASE("A jump of horizontal stress at a material boundary stays sharp", "[transfer]") {
  QuadMesh mesh = ground(0.15);
  for (std::size_t e = 0; e < mesh.num_elements(); ++e)
    mesh.element_material[e] = e % 24 < 12 ? 1 : 2;
  const FemFrame gravity = geostatic(mesh, 0.5, 0.9);
  MapConfig separate = config(), smeared = config();
  for (MapConfig* c : {&separate, &smeared}) {
    c->audit.enforce = false;
    c->mapped_stress = MappedStress::effective;
  }
  smeared.materials = {{"all", soil()}};
  smeared.materials["all"].of = {"tailings", "dam"};
  LiquefactionZone z = dry_zone(mesh);
  // The lattice of separate materials splits cells at the boundary, so the particle's own material
  // decides; r_u of the zone carries it for both configurations.
  for (std::size_t e = 0; e < mesh.num_elements(); ++e)
    z.r_u_element[e] = mesh.element_material[e] - 1;
  z.r_u_node.assign(mesh.num_nodes(), kUnset);
  const auto run = [&](const MapConfig& c) {
    const ParticleSet p = map_state(mesh, gravity, nullptr, z, c).particles;
    double worst = 0.0;
    for (std::size_t i = 0; i < p.size(); ++i) {
      const double v = -(kDensity - 1000.0) * kGravity * (kHeight - p.position[i][1]);
      const double k0 = p.history.at("r_u")[i] < 0.5 ? 0.5 : 0.9;
      worst = std::max(worst, std::abs(p.stress[i][0] + p.pore_pressure[i] - k0 * v));
    }
    return worst / (kDensity * kGravity * kHeight);
  };
  CHECK(run(separate) < 1e-9);
  CHECK(run(smeared) > 0.02);
}

TEST_CASE("Motion of the base is removed and momentum kept", "[transfer]") {
  const QuadMesh mesh = ground(0.2);
  const FemFrame gravity = geostatic(mesh);
  FemFrame shaken = gravity;
  shaken.time = 3.5;
  for (std::size_t n = 0; n < mesh.num_nodes(); ++n) {
    const Vec2 x = mesh.nodes[n];
    shaken.displacement[n] = {0.3 + 0.01 * x[1], -0.2};
    shaken.velocity[n] = {0.5 + 0.02 * x[1], 0.1 - 0.01 * x[0] * x[1]};
  }
  MapConfig c = config();
  const MapResult r = map_state(mesh, gravity, &shaken, dry_zone(mesh), c);
  CHECK(r.audit.base_displacement == Vec2{0.3, -0.2});
  CHECK(r.audit.base_velocity == Vec2{0.5, 0.1});
  CHECK(r.audit.time == 3.5);
  CHECK(check_of(r.audit, "momentum_x").error < 1e-3);
  CHECK(check_of(r.audit, "momentum_y").error < 1e-3);
  CHECK(check_of(r.audit, "kinetic_energy").error < 0.01);
  CHECK(check_of(r.audit, "kinetic_energy").fem > 0.0);
  const ParticleSet& p = r.particles;
  for (std::size_t i = 0; i < p.size(); i += 17) {
    const double y = p.position[i][1];
    CHECK(p.velocity[i][0] == Approx(0.02 * y).epsilon(1e-9));
    CHECK(p.displacement[i][0] == Approx(0.01 * y).epsilon(1e-9));
    CHECK(p.displacement[i][1] == Approx(0.0).margin(1e-12));
  }
  c.remove_base_motion = false;
  const ParticleSet kept = map_state(mesh, gravity, &shaken, dry_zone(mesh), c).particles;
  CHECK(kept.velocity[0][0] > 0.5);
  CHECK(kept.displacement[0][1] == Approx(-0.2));
}

TEST_CASE("What trembles at the end of a record is as good as at rest for the audit",
          "[transfer]") {
  const QuadMesh mesh = ground(0.2);
  const FemFrame gravity = geostatic(mesh);
  const auto audit = [&](double speed) {
    FemFrame shaken = gravity;
    // From node to node to and fro: points between the nodes cannot follow.
    for (std::size_t n = 0; n < mesh.num_nodes(); ++n)
      shaken.velocity[n] = {n % 2 == 0 ? speed : -speed, 0.0};
    MapConfig c = config();
    c.audit.enforce = false;
    return check_of(map_state(mesh, gravity, &shaken, dry_zone(mesh), c).audit, "kinetic_energy");
  };
  const AuditCheck still = audit(1e-4), moving = audit(1.0);
  CHECK(std::abs(still.particles - still.fem) > 0.01 * still.fem);
  CHECK(still.passed());
  CHECK_FALSE(moving.passed());
}

TEST_CASE("Liquefied soil becomes a material of its own with strength at each point",
          "[transfer]") {
  const QuadMesh mesh = ground(0.1);
  const FemFrame gravity = geostatic(mesh);
  LiquefactionZone z = dry_zone(mesh);
  for (std::size_t e = 0; e < mesh.num_elements(); ++e) {
    const Vec2 x = centroid(corners(mesh, mesh.nodes, e));
    if (e / 24 < 6) continue;
    z.liquefied[e] = 1;
    z.strength[e] = 9e3 - 500.0 * x[1];
  }
  MapConfig c = config();
  const MapResult r = map_state(mesh, gravity, nullptr, z, c);
  const ParticleSet& p = r.particles;
  REQUIRE(p.materials.size() == 3);
  CHECK(p.materials[2].name == "liquefied tailings");
  CHECK(p.materials[2].law == "residual_strength");
  int liquefied = 0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const double s = p.history.at("strength")[i];
    if (p.material[i] != 2) {
      CHECK(s == 0.0);
      continue;
    }
    ++liquefied;
    const double exact = 9e3 - 500.0 * p.position[i][1];
    CHECK(std::abs(s - exact) < 300.0);  // clamped to its sources in the outermost half element
    CHECK(p.history.at("soft_strength")[i] == Approx(0.5 * s));
    const Stress<2> sigma{{p.stress[i][0], p.stress[i][1], p.stress[i][2], p.stress[i][3]}};
    CHECK(equivalent_shear(sigma) <= std::sqrt(3.0) * s * (1 + 1e-9));
    CHECK(p.history.at("plastic_strain")[i] == 0.0);
  }
  CHECK(liquefied > 500);
  CHECK(check_of(r.audit, "yield_before").error > 0.5);
  CHECK(check_of(r.audit, "yield_after").error < 1e-9);
  CHECK(check_of(r.audit, "stress_yy_returned").error < 1e-4);
  CHECK(check_of(r.audit, "stress_xx_returned").error > 0.02);

  c.liquefied_return = LiquefiedReturn::mean_stress;
  const MapResult mean = map_state(mesh, gravity, nullptr, z, c);
  CHECK(mean.audit.returned.rms > 5.0 * r.audit.returned.rms);

  c.strength = StrengthPerPoint::element;
  const ParticleSet binned = map_state(mesh, gravity, nullptr, z, c).particles;
  for (std::size_t i = 0; i < binned.size(); i += 13) {
    const double s = binned.history.at("strength")[i];
    CHECK((binned.material[i] != 2 ||
           std::find(z.strength.begin(), z.strength.end(), s) != z.strength.end()));
  }
}

TEST_CASE("Plastic strain at the start is the strain since rest without its elastic part",
          "[transfer]") {
  const QuadMesh mesh = ground(0.0);
  FemFrame gravity = geostatic(mesh);
  for (auto& e : gravity.strain) e[3] = 0.002;
  FemFrame shaken = gravity;
  const double shear = 20e6 / 2.6;
  for (std::size_t e = 0; e < mesh.num_elements(); ++e) {
    shaken.strain[e][3] += 0.05;
    shaken.stress[e][3] += 1e3;
  }
  MapConfig c = config();
  c.audit.enforce = false;
  const auto strain = [&](InitialStrain rule) {
    c.initial_strain = rule;
    return map_state(mesh, gravity, &shaken, dry_zone(mesh), c)
        .particles.history.at("plastic_strain")[40];
  };
  CHECK(strain(InitialStrain::total) == Approx(0.05 / std::sqrt(3.0)));
  CHECK(strain(InitialStrain::plastic) == Approx((0.05 - 1e3 / shear) / std::sqrt(3.0)));
  CHECK(strain(InitialStrain::zero) == 0.0);
}

TEST_CASE("Total friction hands over no pore pressure", "[transfer]") {
  const QuadMesh mesh = ground(0.0);
  MapConfig c = config();
  c.friction_acts_on = FrictionStress::total;
  const MapResult r = map_state(mesh, geostatic(mesh), nullptr, dry_zone(mesh), c);
  for (const double u : r.particles.pore_pressure) CHECK(u == 0.0);
  CHECK(check_of(r.audit, "pore_pressure").error < 1e-6);
}

TEST_CASE("Audit limits stop the run and name what exceeds them", "[transfer]") {
  const QuadMesh mesh = ground(0.15);
  FemFrame gravity = geostatic(mesh);
  for (auto& s : gravity.stress) s[1] *= 0.5;
  CHECK_THROWS_AS(map_state(mesh, gravity, nullptr, dry_zone(mesh), config()), NumericsError);
  CHECK_THROWS_WITH(map_state(mesh, gravity, nullptr, dry_zone(mesh), config()),
                    Catch::Contains("out_of_balance_rms: 0.2") && Catch::Contains("worst node") &&
                        !Catch::Contains("smaller cell or") && Catch::Contains("audit.enforce"));
  MapConfig c = config();
  c.audit.enforce = false;
  CHECK_FALSE(map_state(mesh, gravity, nullptr, dry_zone(mesh), c).audit.passed());
}

TEST_CASE("Data that do not fit together are refused", "[transfer]") {
  QuadMesh mesh = ground(0.1);
  const FemFrame gravity = geostatic(mesh);
  LiquefactionZone z = dry_zone(mesh);
  MapConfig c = config();

  mesh.element_material[7] = 99;
  CHECK_THROWS_WITH(map_state(mesh, gravity, nullptr, z, c),
                    Catch::Contains("element 507 is of the material 'rock', which is not among"));
  c.box = {.left = 10.0, .right = 20.0, .bottom = 0.0, .top = 12.0};
  CHECK_NOTHROW(map_state(mesh, gravity, nullptr, z, c));
  c.box = {.left = 100.0, .right = 200.0, .bottom = {}, .top = {}};
  CHECK_THROWS_WITH(map_state(mesh, gravity, nullptr, z, c), Catch::Contains("inside the box"));
  mesh.element_material[7] = 1;
  c = config();

  z.liquefied[3] = 1;
  CHECK_THROWS_WITH(map_state(mesh, gravity, nullptr, z, c),
                    Catch::Contains("element 503 has strength"));
  c.materials["tailings"].liquefied.reset();
  CHECK_THROWS_WITH(map_state(mesh, gravity, nullptr, z, c),
                    Catch::Contains("no law for liquefied soil"));
  z.liquefied.pop_back();
  CHECK_THROWS_WITH(map_state(mesh, gravity, nullptr, z, config()),
                    Catch::Contains("another mesh"));

  FemFrame broken = gravity;
  broken.stress[30][1] = kUnset;
  CHECK_THROWS_AS(map_state(mesh, broken, nullptr, dry_zone(mesh), config()), Error);
  broken = gravity;
  broken.displacement[30][1] = kUnset;
  CHECK_THROWS_AS(map_state(mesh, broken, nullptr, dry_zone(mesh), config()), InputError);
  broken = gravity;
  broken.velocity.pop_back();
  CHECK_THROWS_AS(map_state(mesh, gravity, &broken, dry_zone(mesh), config()), InputError);
}

TEST_CASE("The same state comes from a file, and the audit is written", "[transfer]") {
  const Scratch folder;
  const QuadMesh mesh = ground(0.15);
  const FemFrame gravity = geostatic(mesh);
  {
    FemHistoryWriter writer(folder / "history.h5", mesh, kSoils, {"test", "given", {}});
    writer.set_gravity(gravity);
    writer.finish();
  }
  LiquefactionZone z = dry_zone(mesh);
  const FemHistory history(folder / "history.h5");
  const MapResult a = map_state(history, z, config());
  const MapResult b = map_state(mesh, gravity, nullptr, z, config());
  CHECK(a.particles.position == b.particles.position);
  CHECK(a.particles.stress == b.particles.stress);
  z.transfer_frame = 4;
  CHECK_THROWS_WITH(map_state(history, z, config()), Catch::Contains("frame 4"));

  write_audit(folder / "audit.json", a.audit);
  std::ifstream file(folder / "audit.json");
  const auto json = nlohmann::json::parse(file);
  CHECK(json.at("kind") == "transfer_audit");
  CHECK(json.at("passed") == true);
  CHECK(json.at("counts").at("points") == a.particles.size());
  CHECK(json.at("checks").at(0).at("name") == "mass");
  CHECK_THROWS_AS(write_audit(folder / "absent/audit.json", a.audit), FileError);
}

TEST_CASE("The published script's points are audited but not judged", "[transfer]") {
  const Scratch folder;
  const auto path = folder / "history.h5";
  const QuadMesh mesh = ground(0.15);
  FemFrame gravity = geostatic(mesh);
  {
    FemHistoryWriter writer(path, mesh, kSoils, {"test", "given", {}});
    writer.set_gravity(gravity);
    writer.finish();
  }
  SordoTransferConfig c;
  c.cell = 1.0;
  c.base_node = 100;
  c.soils = {"tailings", "dam", "rock"};
  c.keep_x = {-1.0, 30.0};
  LiquefactionZone at_rest = dry_zone(mesh);
  at_rest.transfer_frame = -1;
  const SordoResult r = map_sordo2024_audited(FemHistory(path), at_rest, c);
  CHECK(r.particles.toe == Approx(24.0));
  c.soils.tailings = "1";
  CHECK_THROWS_WITH(map_sordo2024_audited(FemHistory(path), at_rest, c),
                    Catch::Contains("tailings: 1 is a tag"));
  CHECK(r.particles.size() == 4 * mesh.num_elements());
  CHECK(r.audit.passed());
  CHECK_FALSE(r.audit.notes.empty());
  CHECK(check_of(r.audit, "mass").error < 1e-9);
  // sigma_zz is one of its defects: nothing of it arrives.
  CHECK(check_of(r.audit, "stress_zz").error > 0.5);
}

TEST_CASE("Settings of the map are read from YAML", "[transfer]") {
  const Scratch folder;
  const auto path = folder.write("map.yaml", R"(cell: 1.25 m
c_soft_ratio: 0.5
box: {left: -340 m, right: 87.5 m, bottom: -5 m}
return: mean_stress
materials:
  embankment:
    mohr_coulomb: {youngs_modulus: 20 MPa, poisson_ratio: 0.3, cohesion: 25 kPa, friction_angle: 35 deg}
  tailings:
    mohr_coulomb: {youngs_modulus: 20 MPa, poisson_ratio: 0.3, cohesion: 1 kPa, friction_angle: 30 deg}
    liquefied: {youngs_modulus: 5 MPa, poisson_ratio: 0.49}
  foundation:
    linear_elastic: {youngs_modulus: 100 MPa, poisson_ratio: 0.3}
    counts_for_runout: false
audit: {enforce: false}
)");
  MapConfig c = read_settings<MapConfig>(load_yaml(path), "map");
  CHECK_NOTHROW(check(c));
  CHECK(c.cell == 1.25);
  CHECK(box_of(c.box).xmin == -340.0);
  CHECK_FALSE(c.box.top.has_value());
  CHECK(c.liquefied_return == LiquefiedReturn::mean_stress);
  CHECK(c.materials.at("tailings").liquefied->residual_strain == 1.0);
  CHECK(c.materials.at("foundation").law.of<LinearElastic>()->youngs_modulus == 100e6);
  CHECK_FALSE(c.materials.at("foundation").counts_for_runout);
  CHECK_FALSE(c.audit.enforce);

  MapConfig bad = c;
  bad.materials["embankment"].of = {"dam", "tailings"};
  CHECK_THROWS_WITH(check(bad), Catch::Contains("'tailings' of the section becomes two"));
  bad = c;
  bad.c_soft_ratio.reset();
  CHECK_THROWS_WITH(check(bad), Catch::Contains("c_soft_ratio is missing"));
  bad = c;
  bad.materials["tailings"].liquefied->strength = 50e3;
  CHECK_THROWS_WITH(check(bad), Catch::Contains("tailings.liquefied gives strength"));
  bad.materials["tailings"].liquefied->strength.reset();
  bad.materials["tailings"].liquefied->soft_strength = 5e3;
  CHECK_THROWS_WITH(check(bad), Catch::Contains("tailings.liquefied gives soft_strength"));
  bad = c;
  bad.materials["foundation"].law = {};
  ResidualStrength::Params& soft = bad.materials["foundation"].law.of<ResidualStrength>().emplace();
  soft.youngs_modulus = 20e6;
  soft.poisson_ratio = 0.45;
  soft.strength = 5e3;
  CHECK_THROWS_WITH(
      check(bad),
      Catch::Contains("materials.foundation.residual_strength: 'soft_strength' is missing"));
  bad.materials["foundation"].law.of<ResidualStrength>()->soft_strength = 5e3;
  CHECK_NOTHROW(check(bad));
  bad = c;
  bad.box = {.left = 1.0, .right = 0.0, .bottom = {}, .top = {}};
  CHECK_THROWS_AS(check(bad), InputError);
  bad = c;
  bad.materials["sand"] = soil();
  bad.materials["sand"].of = {"sand 1", "sand 2"};
  CHECK_NOTHROW(check(bad));
}
