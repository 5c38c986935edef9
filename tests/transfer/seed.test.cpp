#include "transfer/seeding/seed.hpp"

#include "core/check.hpp"
#include "distorted_mesh.hpp"

#include <cmath>

#include <catch2/catch.hpp>

using namespace flowslide;
using flowslide::test::distorted_mesh;

namespace {

constexpr Box kEverywhere{-1e300, 1e300, -1e300, 1e300};

SeedDomain whole(const QuadMesh& mesh, const std::vector<Vec2>& positions) {
  SeedDomain d{mesh, positions, {}, {}, kEverywhere};
  for (std::size_t e = 0; e < mesh.num_elements(); ++e) {
    d.density.push_back(1500.0 + 10.0 * static_cast<double>(e));
    d.group.push_back(e % 7 < 3 ? 0 : 1);
  }
  return d;
}

std::vector<Vec2> stretched(const QuadMesh& mesh) {
  std::vector<Vec2> x = mesh.nodes;
  for (Vec2& v : x) v = {1.1 * v[0] + 0.2 * v[1], 0.9 * v[1] + 0.001 * v[0] * v[0]};
  return x;
}

}  // namespace

TEST_CASE("Lattice seeding conserves volume, mass and centroid of each group", "[transfer]") {
  for (const std::uint64_t seed : {1, 2, 3, 4}) {
    const QuadMesh mesh = distorted_mesh(9, 6, -340.0, 19.0, 11.0, 0.3, seed);
    const std::vector<Vec2> positions = stretched(mesh);
    const SeedDomain domain = whole(mesh, positions);
    for (const double sliver : {0.0, 0.01, 0.2}) {
      const SeedSet set =
          seed_lattice(domain, {0.37 + 0.1 * static_cast<double>(seed), {0.11, -0.3}, sliver});
      for (const int group : {0, 1}) {
        double volume = 0, mass = 0, moment = 0, area_fem = 0, mass_fem = 0, moment_fem = 0;
        for (const Seed& s : set.seeds) {
          if (s.group != group) continue;
          volume += s.volume;
          mass += s.mass;
          moment += s.volume * s.position[1];
        }
        for (std::size_t e = 0; e < mesh.num_elements(); ++e) {
          if (domain.group[e] != group) continue;
          Polygon p;
          for (const Vec2& v : corners(mesh, positions, e)) p.push(v);
          area_fem += area_moment(p).area;
          moment_fem += area_moment(p).area * area_moment(p).centroid[1];
          mass_fem += domain.density[e] * area(corners(mesh, mesh.nodes, e));
        }
        CHECK(volume == Approx(area_fem).epsilon(1e-12));
        CHECK(mass == Approx(mass_fem).epsilon(1e-12));
        if (set.moved_inside == 0) CHECK(moment == Approx(moment_fem).epsilon(1e-12));
      }
      if (sliver == 0.0) CHECK(set.slivers_merged == 0);
      if (sliver == 0.2) CHECK(set.slivers_merged > 0);
    }
  }
}

TEST_CASE("No point is smaller than a sliver unless it stands alone", "[transfer]") {
  const QuadMesh mesh = distorted_mesh(9, 6, 0.0, 18.3, 11.7, 0.3, 5);
  const SeedDomain domain = whole(mesh, mesh.nodes);
  const LatticeOptions options{0.5, {0.0, 0.0}, 0.05};
  const SeedSet set = seed_lattice(domain, options);
  int small = 0;
  for (const Seed& s : set.seeds) small += s.volume <= 0.05 * 0.25 ? 1 : 0;
  CHECK(small == set.slivers_kept);
  CHECK(seed_lattice(domain, {0.5, {0.0, 0.0}, 0.0}).seeds.size() ==
        set.seeds.size() + static_cast<std::size_t>(set.slivers_merged));
}

TEST_CASE("Inside a mesh points lie on the lattice whatever the elements", "[transfer]") {
  const QuadMesh mesh = distorted_mesh(8, 8, 0.0, 8.0, 8.0, 0.3, 6);
  SeedDomain domain = whole(mesh, mesh.nodes);
  domain.group.assign(mesh.num_elements(), 0);
  const SeedSet set = seed_lattice(domain, {0.5, {0.0, 0.0}, 0.01});
  REQUIRE(set.seeds.size() == 256);
  for (const Seed& s : set.seeds) {
    CHECK(s.volume == Approx(0.25).epsilon(1e-12));
    for (int i = 0; i < 2; ++i)
      CHECK(std::abs(s.position[i] - (std::floor(s.position[i] / 0.5) + 0.5) * 0.5) < 1e-12);
  }
}

TEST_CASE("Shape functions of a share return its position", "[transfer]") {
  QuadMesh mesh = distorted_mesh(5, 4, 0.0, 5.0, 4.0, 0.0, 7);
  std::vector<Vec2> positions = mesh.nodes;
  positions[14] = {positions[14][0] + 0.7, positions[14][1] + 0.7};  // a re-entrant corner
  const SeedDomain domain = whole(mesh, positions);
  const SeedSet set = seed_lattice(domain, {0.3, {0.0, 0.0}, 0.0});
  CHECK(set.split_elements > 0);
  double moment = 0.0, moment_shape = 0.0;
  for (const Seed& s : set.seeds) {
    for (int k = s.first_piece; k < s.first_piece + s.num_pieces; ++k) {
      const SeedPiece& piece = set.pieces[static_cast<std::size_t>(k)];
      double sum = 0.0;
      for (int i = 0; i < 4; ++i) {
        sum += piece.shape[i];
        moment_shape += piece.volume * piece.shape[i] *
                        positions[mesh.elements[static_cast<std::size_t>(piece.element)][i]][0];
      }
      CHECK(sum == Approx(1.0).epsilon(1e-12));
    }
  }
  for (std::size_t e = 0; e < mesh.num_elements(); ++e) {
    const ConvexParts parts = convex_parts(corners(mesh, positions, e));
    for (int k = 0; k < parts.count; ++k)
      moment += area_moment(parts.part[k]).area * area_moment(parts.part[k]).centroid[0];
  }
  CHECK(moment_shape == Approx(moment).epsilon(1e-10));
}

TEST_CASE("The box cuts elements exactly", "[transfer]") {
  const QuadMesh mesh = distorted_mesh(9, 6, 0.0, 9.0, 6.0, 0.3, 8);
  SeedDomain domain = whole(mesh, mesh.nodes);
  domain.box = {1.234, 7.77, 0.5, 100.0};
  double volume = 0.0, shares = 0.0;
  for (const Seed& s : seed_lattice(domain, {0.4, {0.0, 0.0}, 0.01}).seeds) volume += s.volume;
  for (std::size_t e = 0; e < mesh.num_elements(); ++e)
    shares += share_inside(domain, e) * area(corners(mesh, mesh.nodes, e));
  CHECK(volume == Approx((7.77 - 1.234) * 5.5).epsilon(1e-12));
  CHECK(shares == Approx((7.77 - 1.234) * 5.5).epsilon(1e-12));
}

TEST_CASE("Gauss seeding weighs with the exact Jacobian", "[transfer]") {
  const QuadMesh mesh = distorted_mesh(6, 5, 0.0, 12.0, 5.0, 0.3, 9);
  const std::vector<Vec2> positions = stretched(mesh);
  const SeedDomain domain = whole(mesh, positions);
  for (const int order : {1, 2, 3, 4}) {
    const SeedSet set = seed_gauss(domain, order);
    double volume = 0.0, mass = 0.0, area_fem = 0.0, mass_fem = 0.0;
    for (const Seed& s : set.seeds) {
      volume += s.volume;
      mass += s.mass;
    }
    for (std::size_t e = 0; e < mesh.num_elements(); ++e) {
      area_fem += area(corners(mesh, positions, e));
      mass_fem += domain.density[e] * area(corners(mesh, mesh.nodes, e));
    }
    CHECK(set.seeds.size() == mesh.num_elements() * static_cast<std::size_t>(order * order));
    CHECK(volume == Approx(area_fem).epsilon(1e-12));
    CHECK(mass == Approx(mass_fem).epsilon(1e-12));
  }
}

TEST_CASE("A folded element and a needlessly fine lattice are refused", "[transfer]") {
  const QuadMesh mesh = distorted_mesh(3, 3, 0.0, 3.0, 3.0, 0.0, 10);
  std::vector<Vec2> positions = mesh.nodes;
  std::swap(positions[5], positions[6]);
  CHECK_THROWS_WITH(seed_lattice(whole(mesh, positions), {0.5, {}, 0.01}),
                    Catch::Contains("element 501 is folded"));
  CHECK_THROWS_AS(seed_gauss(whole(mesh, positions), 2), InputError);
  CHECK_THROWS_WITH(seed_lattice(whole(mesh, mesh.nodes), {1e-6, {}, 0.01}),
                    Catch::Contains("larger cell"));
}
