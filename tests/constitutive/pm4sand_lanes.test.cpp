#include "constitutive/pm4sand_lanes.hpp"

#include "tests/constitutive/pm4sand_samples.hpp"

#include <cstring>
#include <numeric>
#include <random>

#include <catch2/catch.hpp>

using namespace flowslide;
using namespace flowslide::testing;

namespace {

struct Points {
  std::vector<PM4Sand::Constants> soils;
  std::vector<std::size_t> soil;
  std::vector<PM4Sand::State> state;
  std::vector<Stress<2>> stress;
  std::vector<StrainIncrement<2>> strain;
};

/// Points of three soils at 5 to 300 kPa; no multiple of any width.
Points consolidated() {
  Points r;
  for (const auto& p : {pm4sand_tailings(), pm4sand_embankment(), pm4sand_foundation()})
    r.soils.push_back(PM4Sand::constants(p));
  r.soils.back().post_shake = true;
  for (std::size_t i = 0; i < 61; ++i) {
    r.soil.push_back(i % 7 % r.soils.size());
    r.stress.push_back(at_rest(5e3 * static_cast<double>(1 + i)));
    r.state.push_back(PM4Sand::initial_state(r.soils[r.soil[i]], r.stress[i]));
    r.state.back().band = 0.5 + 0.25 * static_cast<double>(i % 5);
  }
  r.strain.resize(r.state.size());
  return r;
}

PM4Sand::Task task(Points& p, std::size_t i) {
  return {&p.soils[p.soil[i]], &p.state[i], &p.stress[i], p.strain[i]};
}

/// Every point by itself.
PM4Sand::Work alone(Points& p) {
  PM4Sand::Work sum;
  for (std::size_t i = 0; i < p.state.size(); ++i) {
    const auto r = PM4Sand::update(p.soils[p.soil[i]], p.state[i], p.stress[i], p.strain[i]);
    p.stress[i] = r.stress;
    p.state[i] = r.state;
    sum.sub_steps += r.sub_steps;
    sum.rejected += r.rejected;
    sum.floored += r.floored;
  }
  return sum;
}

/// All points on the lanes of a T, in the order given.
template <class T>
PM4Sand::Work together(Points& p, const std::vector<std::size_t>& order) {
  std::size_t next = 0;
  return pm4sand::integrate<T>([&](PM4Sand::Task& t) {
    if (next == order.size()) return false;
    t = task(p, order[next++]);
    return true;
  });
}

bool same(const Points& a, const Points& b) {
  return std::memcmp(a.state.data(), b.state.data(), a.state.size() * sizeof a.state[0]) == 0 &&
         std::memcmp(a.stress.data(), b.stress.data(), a.stress.size() * sizeof a.stress[0]) == 0;
}

/// Shears all points for some steps, some of them much more than others, one not at all, one by
/// what is not a number in the end; `widths(points, order)` is called instead of `alone` on a copy.
template <class F>
void compare(F&& widths) {
  Points a = consolidated(), b = a;
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  std::vector<std::size_t> order(a.state.size());
  std::iota(order.begin(), order.end(), 0);
  int sub_steps = 0, rejected = 0, floored = 0;
  for (int step = 0; step < 60; ++step) {
    const double sign = step / 6 % 2 == 0 ? 1.0 : -1.0;
    for (std::size_t i = 0; i < a.strain.size(); ++i) {
      const double size = i % 9 == 0 ? 2e-3 : i == 5 ? 0.0 : 4e-5;
      a.strain[i] = {{0.1 * size * uniform(random), 0.1 * size * uniform(random), 0.0,
                      size * (sign + uniform(random))}};
    }
    if (step == 59) a.strain[10][3] = kUnset;
    b.strain = a.strain;
    std::shuffle(order.begin(), order.end(), random);
    const PM4Sand::Work one = alone(a), many = widths(b, order);
    REQUIRE(same(a, b));
    CHECK(one.sub_steps == many.sub_steps);
    CHECK(one.rejected == many.rejected);
    CHECK(one.floored == many.floored);
    sub_steps += one.sub_steps;
    rejected += one.rejected;
    floored += one.floored;
  }
  CHECK(std::isnan(a.stress[10][3]));
  // control: sub-steps of all kinds, and far from the state at rest
  CHECK(sub_steps > 20000);
  CHECK(rejected > 1000);
  CHECK(floored > 100);
}

}  // namespace

TEST_CASE("PM4Sand has the same bits in any company and on any number of lanes",
          "[pm4sand][bits]") {
  SECTION("as elements of a mesh") {
    compare([](Points& p, const std::vector<std::size_t>& order) {
      std::size_t next = 0;
      return PM4Sand::update_all([&](PM4Sand::Task& t) {
        if (next == order.size()) return false;
        t = task(p, order[next++]);
        return true;
      });
    });
  }
  SECTION("2 lanes") { compare(together<PackOf<2>>); }
  if constexpr (kPackLanes >= 4) {
    SECTION("4 lanes") { compare(together<PackOf<std::min(4, kPackLanes)>>); }
  }
  if constexpr (kPackLanes >= 8) {
    SECTION("8 lanes") { compare(together<PackOf<std::min(8, kPackLanes)>>); }
  }
}

TEST_CASE("PM4Sand's lanes do nothing without points", "[pm4sand]") {
  const PM4Sand::Work none = PM4Sand::update_all([](PM4Sand::Task&) { return false; });
  CHECK(none.sub_steps + none.rejected + none.floored == 0);
}

TEST_CASE("PM4Sand ends in time whatever state and strain it is given", "[pm4sand]") {
  // What a forged checkpoint may hold; each took hours of sub-steps or never ended.
  const PM4Sand::Constants soil = PM4Sand::constants(pm4sand_tailings());
  const Stress<2> sigma = at_rest(1e5);
  const auto limit = static_cast<int>(pm4sand::kMaxSubSteps) + 2;  // rounding may leave a bit
  const auto ends = [&](const PM4Sand::State& state) {
    for (const double strain : {1e-5, 0.9})
      CHECK(PM4Sand::update(soil, state, sigma, {{strain, 0.0, 0.0, strain}}).sub_steps < limit);
  };
  const PM4Sand::State good = PM4Sand::initial_state(soil, sigma);
  for (const double huge : {1e4, 1e100, 1e250, -1e300, double(NAN)}) {
    CAPTURE(huge);
    PM4Sand::State state = good;
    state.alpha.d = state.z.t = huge;
    ends(state);
    state = good;
    state.void_ratio = state.z_cum = huge;
    ends(state);
    for (double PM4Sand::State::*member : {&PM4Sand::State::held_p, &PM4Sand::State::p_min,
                                           &PM4Sand::State::z_max, &PM4Sand::State::band}) {
      state = good;
      state.*member = huge;
      ends(state);
    }
    CHECK(std::isnan(PM4Sand::update(soil, good, sigma, {{huge, 0.0, 0.0, 0.0}}).stress[0]));
  }
  for (const double huge : {1e160, -1e250}) {
    const StrainIncrement<2> little{{1e-5, 0.0, 0.0, 1e-5}};
    CHECK(std::isnan(PM4Sand::update(soil, good, {{huge, huge, huge, 0.0}}, little).stress[0]));
  }
}
