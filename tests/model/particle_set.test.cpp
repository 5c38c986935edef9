#include "model/particle_set.hpp"

#include "core/check.hpp"
#include "model/field_store.hpp"
#include "tests/model/scratch.hpp"

#include <cmath>
#include <cstring>

#include <catch2/catch.hpp>

using namespace flowslide;
using Catch::Matchers::Contains;

namespace {

ParticleSet some_particles(std::size_t n) {
  ParticleSet p;
  p.history["plastic_strain"] = {};
  p.history["r_u"] = {};
  resize(p, n);
  p.materials = {{"dam", "mohr_coulomb", {{"friction_angle", 0.6}, {"youngs_modulus", 2e7}}, true},
                 {"foundation", "linear_elastic", {}, false}};
  p.notes = {"first", "second"};
  for (std::size_t i = 0; i < n; ++i) {
    const double x = static_cast<double>(i);
    p.position[i] = {x / 3.0, -x / 7.0, 0.0};
    p.velocity[i] = {0.1 * x, 1e-310, -0.0};
    p.displacement[i] = {x * 1e-3, 0.0, 0.0};
    p.mass[i] = 1800.0 + x;
    p.volume[i] = 1.0 + x / 11.0;
    p.stress[i] = {-1.0 - x, -2.0, -3.0, 0.4, 0.0, 0.0};
    p.pore_pressure[i] = 1e3 / (1.0 + x);
    p.material[i] = static_cast<std::int32_t>(i % 2);
    p.id[i] = 1000 - static_cast<std::int64_t>(i);
    p.history["plastic_strain"][i] = x / 13.0;
    p.history["r_u"][i] = i == 0 ? kUnset : 0.9;
  }
  return p;
}

template <class T>
bool same_bits(const std::vector<T>& a, const std::vector<T>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0;
}

}  // namespace

TEST_CASE("particles come back from the file to the bit") {
  const Scratch folder;
  const ParticleSet p = some_particles(100);
  write_particles(folder / "p.h5", p);
  ParticleSet q = read_particles(folder / "p.h5");
  CHECK(q.dim == 2);
  CHECK(same_bits(p.position, q.position));
  CHECK(same_bits(p.velocity, q.velocity));
  CHECK(same_bits(p.displacement, q.displacement));
  CHECK(same_bits(p.mass, q.mass));
  CHECK(same_bits(p.volume, q.volume));
  CHECK(same_bits(p.stress, q.stress));
  CHECK(same_bits(p.pore_pressure, q.pore_pressure));
  CHECK(p.material == q.material);
  CHECK(p.id == q.id);
  REQUIRE(q.history.size() == 2);
  CHECK(same_bits(p.history.at("plastic_strain"), q.history.at("plastic_strain")));
  CHECK(same_bits(p.history.at("r_u"), q.history.at("r_u")));
  REQUIRE(q.materials.size() == 2);
  CHECK(q.materials[0].name == "dam");
  CHECK(q.materials[0].law == "mohr_coulomb");
  CHECK(q.materials[0].parameters == p.materials[0].parameters);
  CHECK(q.materials[0].counts_for_runout);
  CHECK(q.materials[1].parameters.empty());
  CHECK_FALSE(q.materials[1].counts_for_runout);
  CHECK(q.notes == p.notes);
}

TEST_CASE("particles without history and parameters are kept") {
  const Scratch folder;
  ParticleSet p = some_particles(1);
  p.history.clear();
  p.materials[0].parameters.clear();
  write_particles(folder / "p.h5", p);
  const ParticleSet q = read_particles(folder / "p.h5");
  CHECK(q.history.empty());
  CHECK(q.materials[0].parameters.empty());
}

TEST_CASE("resize covers every array") {
  ParticleSet p = some_particles(5);
  resize(p, 3);
  CHECK_NOTHROW(check(p));
  CHECK(p.history.at("r_u").size() == 3);
}

namespace {

/// Neither passes the check nor is written.
void refused(const ParticleSet& p, const std::string& text) {
  const Scratch folder;
  CHECK_THROWS_WITH(check(p), Contains(text));
  CHECK_THROWS_AS(write_particles(folder / "p.h5", p), InputError);
  CHECK_FALSE(std::filesystem::exists(folder / "p.h5"));
}

}  // namespace

TEST_CASE("particles with a wrong number are refused with their id") {
  ParticleSet p = some_particles(4);
  REQUIRE_NOTHROW(check(p));
  SECTION("mass zero") {
    p.mass[2] = 0.0;
    refused(p, "particle 998 has the mass 0");
  }
  SECTION("mass NaN") {
    p.mass[2] = kUnset;
    refused(p, "particle 998 has the mass nan");
  }
  SECTION("volume negative") {
    p.volume[1] = -1.0;
    refused(p, "particle 999 has the volume -1");
  }
  SECTION("stress NaN") {
    p.stress[3][2] = kUnset;
    refused(p, "particle 997: stress is not finite");
  }
  SECTION("position infinite") {
    p.position[0][1] = INFINITY;
    refused(p, "position is not finite");
  }
  SECTION("history infinite") {
    p.history["r_u"][1] = INFINITY;
    refused(p, "r_u is infinite");
  }
}

TEST_CASE("particles that contradict themselves are refused") {
  ParticleSet p = some_particles(4);
  REQUIRE_NOTHROW(check(p));
  SECTION("material unknown") {
    p.material[0] = 2;
    refused(p, "material index 2");
  }
  SECTION("material negative") {
    p.material[0] = -1;
    refused(p, "material index -1");
  }
  SECTION("id twice") {
    p.id[0] = 999;
    refused(p, "id 999 occurs twice");
  }
  SECTION("short array") {
    p.velocity.pop_back();
    refused(p, "3 values of velocity");
  }
  SECTION("short history") {
    p.history["r_u"].pop_back();
    refused(p, "3 values of r_u");
  }
  SECTION("history name") {
    p.history["a/b"].resize(4);
    refused(p, "'a/b'");
  }
  SECTION("parameter NaN") {
    p.materials[0].parameters["c"] = kUnset;
    refused(p, "'c' is nan");
  }
  SECTION("material twice") {
    p.materials[1].name = "dam";
    refused(p, "called 'dam'");
  }
  SECTION("dimension") {
    p.dim = 1;
    refused(p, "dimension 1");
  }
  SECTION("none") {
    resize(p, 0);
    refused(p, "no particles");
  }
}

TEST_CASE("a particle file of an older version is refused with a word") {
  const Scratch folder;
  FieldWriter out(folder / "p.h5", "particles", 1);  // without a toe
  out.finish();
  CHECK_THROWS_WITH(read_particles(folder / "p.h5"),
                    Contains("format version 1 of particles") && Contains("make the file again"));
}

TEST_CASE("a particle file whose content contradicts itself is refused by name") {
  const Scratch folder;
  FieldWriter out(folder / "p.h5", "particles", 2);
  out.write("dim", std::vector<std::int32_t>{2}, {.unit = ""});
  out.write("toe", std::vector<double>{1.0}, {.unit = "m"});
  out.write("particles/position", std::vector<std::array<double, 3>>(2), {.unit = "m"});
  out.write("particles/velocity", std::vector<std::array<double, 3>>(3), {.unit = "m/s"});
  out.finish();
  CHECK_THROWS_WITH(read_particles(folder / "p.h5"),
                    Contains("particles/velocity") && Contains("(3, 3)") && Contains("(2, 3)"));
}
