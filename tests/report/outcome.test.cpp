#include "report/outcome.hpp"

#include "report/composition.hpp"
#include "report/facts.hpp"
#include "tests/report/dam_case.hpp"
#include "transfer/seeding/seed.hpp"

#include <catch2/catch.hpp>

using namespace flowslide;

namespace {

/// A block of 40 x 20 points of 1 m on level ground at y = 0; `shake` before and `flow` after the
/// transfer move the points with y > 10.
struct Block {
  ParticleSet p;
  FinalState end;

  Block(std::array<double, 2> shake, std::array<double, 2> flow, double moved = 1.0) {
    p.materials = {
        {.name = "embankment", .law = "mohr_coulomb", .parameters = {}},
        {.name = "liquefied 1", .law = "residual_strength", .parameters = {}, .liquefied = true}};
    for (int i = 0; i < 40; ++i)
      for (int j = 0; j < 20; ++j) {
        const bool moves = j >= 10;
        const std::array<double, 3> from{i + 0.5, j + 0.5, 0.0};
        std::array<double, 3> at = from, u{};
        if (moves) {
          u = {shake[0], shake[1], 0.0};
          for (int d = 0; d < 2; ++d) at[d] += shake[d];
        }
        p.position.push_back(at);
        p.displacement.push_back(u);
        p.material.push_back(i < 20 ? 1 : 0);
        p.id.push_back(std::int64_t(p.id.size()));
        if (moves)
          for (int d = 0; d < 2; ++d) at[d] += flow[d];
        end.undeformed.push_back(from);
        end.position.push_back(at);
        end.displacement.push_back(std::hypot(at[0] - from[0], at[1] - from[1]));
        end.counts.push_back(1);
        end.failed.push_back(end.displacement.back() > moved);
      }
    p.volume.assign(p.size(), 1.0);
    p.mass.assign(p.size(), 2000.0);
  }
};

}  // namespace

TEST_CASE("Displacements of shaking and of flow stand apart") {
  ReportConfig config;
  config.pond = 19.0;
  const Block b({0.2, -0.3}, {0.4, -0.1});
  const OutcomeFacts f = outcome_facts(b.p, b.end, config);
  CHECK(f.largest.shaking == Approx(std::hypot(0.2, 0.3)));
  CHECK(f.largest.flow == Approx(std::hypot(0.4, 0.1)));
  CHECK(f.largest.both == Approx(std::hypot(0.6, 0.4)));
  CHECK(f.mean.both == Approx(0.5 * f.largest.both));
  CHECK(f.crest.x == 39.5);
  CHECK(f.crest.level == Approx(20.0));
  CHECK(f.crest.outward.shaking == Approx(0.2));
  CHECK(f.crest.outward.both == Approx(0.6));
  CHECK(f.crest.settlement.shaking == Approx(0.3));
  CHECK(f.crest.settlement.flow == Approx(0.1));
  CHECK(f.crest.freeboard == Approx(0.6));
  CHECK_FALSE(is_set(outcome_facts(b.p, b.end, {}).crest.freeboard));
}

TEST_CASE("The level of the crest is that of the section, however its surface cuts the points") {
  ReportConfig config;
  config.pond = 18.0;
  // Height that the surface left of the uppermost row of points, of 1 m.
  for (const double left : {1.0, 0.7, 0.3, 0.02}) {
    CAPTURE(left);
    Block b({0.0, -0.5}, {0.0, 0.0});
    for (std::size_t i = 19; i < b.p.size(); i += 20) {
      b.p.volume[i] = left;
      b.p.mass[i] *= left;
      for (auto* y : {&b.end.undeformed[i][1], &b.end.position[i][1], &b.p.position[i][1]})
        *y -= 0.5 * (1.0 - left);
    }
    const CrestFacts c = outcome_facts(b.p, b.end, config).crest;
    CHECK(c.level == Approx(19.0 + left));
    CHECK(c.freeboard == Approx(19.0 + left - 0.5 - 18.0));
  }
}

TEST_CASE("The crest of a seeded section is as high as its mesh before the earthquake") {
  // A trapezium of 60 m with a crest of 10 m at y = 12: lattices that end there and that do not,
  // and points of which some are small.
  QuadMesh m;
  constexpr int columns = 30, rows = 12;
  for (int i = 0; i <= columns; ++i)
    for (int j = 0; j <= rows; ++j) {
      const double y = 12.0 * j / rows, x = (i - 0.5 * columns) * (2.0 - 5.0 / 3.0 * y / 12.0);
      m.nodes.push_back({x, y});
    }
  for (int i = 0; i < columns; ++i)
    for (int j = 0; j < rows; ++j) {
      const int a = i * (rows + 1) + j;
      m.elements.push_back({a, a + rows + 1, a + rows + 2, a + 1});
      m.element_tags.push_back(std::ssize(m.elements));
    }
  const std::size_t n = m.num_elements();
  const SeedDomain domain{m,
                          m.nodes,
                          std::vector<double>(n, 1900.0),
                          std::vector<std::int32_t>(n, 0),
                          {-1e3, 1e3, -1e3, 1e3}};
  for (const double spacing : {0.5, 0.375, 0.7, 1.0})
    for (const double from : {0.0, 0.11, 0.29, 0.46}) {
      CAPTURE(spacing, from);
      const SeedSet seeds = seed_lattice(domain, {.spacing = spacing, .origin = {0.0, from}});
      ParticleSet p;
      FinalState end;
      resize(p, seeds.seeds.size());
      for (std::size_t i = 0; i < p.size(); ++i) {
        p.position[i] = {seeds.seeds[i].position[0], seeds.seeds[i].position[1], 0.0};
        p.volume[i] = seeds.seeds[i].volume;
        p.mass[i] = seeds.seeds[i].mass;
      }
      end.undeformed = end.position = p.position;
      end.displacement.assign(p.size(), 0.0);
      end.counts.assign(p.size(), 1);
      end.failed.assign(p.size(), 0);
      CHECK(outcome_facts(p, end, {}).crest.level == Approx(12.0).margin(0.03));
    }
}

TEST_CASE("A word for what happened, by stated limits") {
  const auto say = [](std::array<double, 2> shake, std::array<double, 2> flow) {
    const Block b(shake, flow);
    return word(outcome_facts(b.p, b.end, {}).outcome);
  };
  CHECK(say({0.05, 0.0}, {0.0, 0.0}) == "stood");
  CHECK(say({0.21, -0.37}, {0.0, 0.0}) == "deformed");  // did not fail
  CHECK(say({0.5, 0.0}, {0.6, 0.0}) == "slid");
  CHECK(say({0.0, 0.0}, {18.0, 0.0}) == "slid");  // less than the height of 19 m
  CHECK(say({0.0, 0.0}, {20.0, 0.0}) == "flowed");
  // The same way by shaking alone is no flow.
  CHECK(say({20.0, 0.0}, {0.0, 0.0}) == "slid");
}

TEST_CASE("Three of eight hundred points do not decide") {
  Block b({0.0, 0.0}, {0.0, 0.0});
  for (int i = 0; i < 3; ++i) {
    b.end.position[i][0] += 100.0;
    b.end.displacement[i] = 100.0;
  }
  CHECK(outcome_facts(b.p, b.end, {}).outcome == Outcome::stood);
  for (int i = 3; i < 8; ++i) {
    b.end.position[i][0] += 100.0;
    b.end.displacement[i] = 100.0;
  }
  CHECK(outcome_facts(b.p, b.end, {}).outcome == Outcome::flowed);
}

TEST_CASE("The foremost 1 % are told by material, and liquefied soil apart") {
  const Block b({0.0, 0.0}, {5.0, 0.0});  // the embankment leads
  const Composition c = composition(b.p, b.end, 30.0);
  REQUIRE(c.foremost.size() == 1);
  CHECK(c.foremost[0].material == "embankment");
  CHECK(c.foremost[0].share == 1.0);
  CHECK(c.fronts.fifth == Approx(44.5));
  CHECK(c.liquefied);
  CHECK(c.liquefied_fronts.fifth == Approx(24.5));
  CHECK(c.mass_past_toe == Approx(2000.0 * (10 * 10 + 10 * 15)));
  CHECK(c.height == Approx(19.5));
  Block none = b;
  for (MaterialSpec& m : none.p.materials) m.liquefied = false;
  CHECK_FALSE(composition(none.p, none.end, 30.0).liquefied);
}

TEST_CASE("The area with residual strength is told by r_u") {
  const QuadMesh mesh = dam_case::mesh();
  LiquefactionZone zone = dam_case::zone(mesh, true);
  double in = 0.0, low = 0.0;
  for (std::size_t e = 0; e < mesh.num_elements(); ++e) {
    if (!zone.liquefied[e]) continue;
    const double a = area(corners(mesh, mesh.nodes, e));
    if (e % 3 == 0) zone.r_u_element[e] = 0.2;
    in += a;
    if (e % 3 == 0) low += a;
  }
  const auto shares = zone_shares(mesh, zone);
  REQUIRE(shares.size() == 4);
  CHECK(shares[0].second == 0.0);
  CHECK(shares[1].second == Approx(low / in));
  CHECK(shares[2].second + shares[3].second == Approx(1.0 - low / in));
  CHECK(zone_shares(mesh, dam_case::zone(mesh, false)).empty());
}
