#include "tests/support/limited_files.hpp"

#include "model/checkpoint_file.hpp"
#include "model/field_store.hpp"
#include "model/motion_file.hpp"
#include "model/mpm_history.hpp"
#include "model/resumable_history.hpp"
#include "model/section_mesh.hpp"
#include "model/vtk_writer.hpp"
#include "model/zone.hpp"
#include "tests/support/materials.hpp"

#include <cmath>
#include <random>

using namespace flowslide;
using test::check_limited_files;
namespace fs = std::filesystem;

namespace {

constexpr std::size_t kParticles = 200;

/// Numbers that do not compress.
std::vector<double> noise(std::size_t n, unsigned seed) {
  std::mt19937_64 random(seed);
  std::vector<double> x(n);
  for (double& v : x) v = static_cast<double>(random() >> 11u) * 0x1p-53;
  return x;
}

ParticleSet particles() {
  ParticleSet p;
  resize(p, kParticles);
  p.materials = {{"dam", "mohr_coulomb", {{"cohesion", 1e3}}, true}};
  const std::vector<double> x = noise(kParticles, 1);
  for (std::size_t i = 0; i < kParticles; ++i) {
    p.position[i] = {x[i], 1.0 - x[i], 0.0};
    p.mass[i] = p.volume[i] = 1.0 + x[i];
    p.id[i] = static_cast<std::int64_t>(i);
  }
  return p;
}

MpmFrame particle_frame(unsigned k) {
  MpmFrame f;
  f.time = k;
  for (const double x : noise(kParticles, k)) {
    f.position.push_back({x, -x, 0.0});
    f.velocity.push_back({x, 0.0, 0.0});
    f.stress.push_back({-x, -2.0 * x, -x, 0.1 * x, 0.0, 0.0});
    f.volume.push_back(x);
    f.plastic_strain.push_back(x);
    f.strength.push_back(x);
  }
  return f;
}

void write_runout(const fs::path& path) {
  MpmHistoryWriter out(path, particles(), {});
  for (unsigned k = 0; k < 5; ++k) {
    out.append(particle_frame(k));
    MpmSample sample;
    sample.time = k;
    out.append(sample);
  }
  out.flush();
  out.finish();
  out.remove_parts();
}

QuadMesh strip(std::int32_t cells) {
  QuadMesh m;
  for (std::int32_t i = 0; i <= cells; ++i)
    for (const double y : {0.0, 1.0}) {
      m.nodes.push_back({double(i), y});
      m.node_tags.push_back(std::ssize(m.nodes));
    }
  for (std::int32_t e = 0; e < cells; ++e) {
    m.elements.push_back({2 * e, 2 * e + 2, 2 * e + 3, 2 * e + 1});
    m.element_tags.push_back(e + 1);
    m.element_material.push_back(1);
  }
  return m;
}

FemFrame mesh_frame(const QuadMesh& m, unsigned k) {
  const std::vector<double> x = noise(m.num_nodes(), k);
  FemFrame f;
  f.time = k;
  for (const double u : x) {
    f.displacement.push_back({u, -u});
    f.velocity.push_back({0.5 * u, u});
  }
  f.pore_pressure = x;
  for (std::size_t e = 0; e < m.num_elements(); ++e) {
    f.stress.push_back({{-x[e], -x[e], -x[e], 0.1}});
    f.strain.push_back({{x[e], 0.0, 0.0, x[e]}});
  }
  return f;
}

void write_shaking(const fs::path& path) {
  const QuadMesh m = strip(100);
  ResumableHistoryWriter out(path, m, test::materials_of(m), {"a test", "given", {}},
                             mesh_frame(m, 0), 0);
  for (unsigned k = 1; k < 5; ++k) out.append(mesh_frame(m, k));
  out.flush();
  out.finish();
  out.remove_parts();
}

}  // namespace

TEST_CASE("A runout on a disk that is full at any byte is whole or not there") {
  check_limited_files([](const fs::path& folder) { write_runout(folder / "m.h5"); });
}

TEST_CASE("A shaking on a disk that is full at any byte is whole or not there") {
  check_limited_files([](const fs::path& folder) { write_shaking(folder / "h.h5"); });
}

TEST_CASE("Meshes, motions, zones and particles are whole or not there") {
  const auto check_store = [](auto write) {
    check_limited_files([&](const fs::path& folder) { write(folder / "s.h5"); }, 20);
  };
  check_store([](const fs::path& path) { write_particles(path, particles()); });
  check_store([](const fs::path& path) {
    SectionMesh s;
    s.mesh = strip(50);
    s.materials = {{"sand", 1}};
    s.sets = {{"base", {{0, 2}}}};
    write_section_mesh(path, s);
  });
  check_store([](const fs::path& path) {
    write_motion_file(path, {.dt = 0.01, .acceleration = noise(2000, 3), .origin = "noise"});
  });
  check_store([](const fs::path& path) {
    LiquefactionZone z;
    z.transfer_time = 1.0;
    z.transfer_frame = 0;
    z.r_u_node = noise(600, 1);
    z.r_u_element = z.sigma_v0 = z.strength = noise(500, 2);
    z.liquefied.assign(500, 1);
    z.layer.assign(500, 0);
    write_zone(path, z);
  });
}

TEST_CASE("Pictures and checkpoints are whole or not there") {
  check_limited_files([](const fs::path& folder) {
    const QuadMesh m = strip(100);
    write_vtp(folder / "p.vtp", particles(), particle_frame(1));
    write_vtu(folder / "m.vtu", m, mesh_frame(m, 1));
    write_pvd(folder / "p.pvd", std::vector<std::pair<double, fs::path>>{{0.0, folder / "p.vtp"}});
  });
  check_limited_files([](const fs::path& folder) {
    CheckpointWriter out(folder / "c", 7);
    out.array(noise(3000, 1));
    out.array(noise(20000, 2));  // more than the buffer
    out.finish();
  });
}
