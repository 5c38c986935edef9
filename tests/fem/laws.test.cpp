#include "tests/constitutive/sample_laws.hpp"
#include "verify/fem/scene.hpp"

#include <catch2/catch.hpp>

using namespace flowslide;
using namespace flowslide::fem;

namespace {

/// Lower half of the column of one law, upper half elastic.
template <class M>
Solver column() {
  SectionMesh mesh = section({.columns = 2, .rows = 8, .width = 4.0, .height = 8.0});
  const auto [name, tag] = mesh.materials.front();
  mesh.materials.push_back({"top", tag + 1});
  for (std::size_t e = mesh.mesh.num_elements() / 2; e < mesh.mesh.num_elements(); ++e)
    mesh.mesh.element_material[e] = tag + 1;
  FemMaterialConfig below = soil();
  below.laws.of<M>() = sample_params<M>();
  FemConfig c = config(below, 0.0);
  c.materials["top"] = elastic_soil();
  return at_rest(mesh, c);
}

void shake(Solver& s, double speed, double duration) {
  const auto ground = [speed](double t) { return speed * std::sin(2.0 * kPi * 1.5 * t); };
  while (s.state.time < duration) advance(s, {ground(s.state.time), ground(s.state.time + s.dt)});
}

template <class State>
bool same_state(const State& a, const State& b) {
  return std::memcmp(&a, &b, sizeof a) == 0;
}

}  // namespace

TEMPLATE_LIST_TEST_CASE("Elements follow their law, and energy is balanced", "[fem][bits]",
                        EveryShakingLaw) {
  using M = TestType;
  Solver s = column<M>();
  shake(s, 0.15, 0.5);
  const Solver before = s;
  advance(s, {0.0, 0.0});
  const std::size_t k = ShakingLaws::index<M>();
  std::size_t seen = 0;
  for (std::size_t e = s.layout.law_begin[k]; e < s.layout.law_begin[k + 1]; ++e) {
    const double* d = &s.strain[3 * e];
    Solver old = before;
    const auto own = M::update(constants_of<M>(s, s.layout.material[e]), state_of<M>(old, e),
                               before.state.stress[e], StrainIncrement<2>{{d[0], d[1], 0.0, d[2]}});
    CHECK(distance<2>(own.stress, s.state.stress[e]) == 0.0);
    if constexpr (!std::is_empty_v<typename M::State>)
      CHECK(same_state<typename M::State>(own.state, state_of<M>(s, e)));
    seen += distance<2>(before.state.stress[e], s.state.stress[e]) > 1.0;
  }
  CHECK(seen > 4);  // control: the step does change stresses
  shake(s, 0.15, 2.0);
  CHECK(s.state.energy.base > 1e3);
  CHECK(s.state.energy.error() < 1e-10);
}

TEMPLATE_TEST_CASE("Soil without friction carries no more shear than its cohesion", "[fem]",
                   MohrCoulomb, DruckerPrager) {
  using M = TestType;
  const auto most = [](double cohesion) {
    FemMaterialConfig m = soil();
    typename M::Params p = sample_params<M>();
    p.friction_angle = p.dilation_angle = 0.0;
    p.cohesion = cohesion;
    p.tension_cutoff = 1e9;
    m.laws.of<M>() = p;
    m.k0 = 0.98;  // the plane has little shear of its own at rest
    Solver s =
        at_rest(section({.columns = 2, .rows = 8, .width = 4.0, .height = 8.0}), config(m, 0.0));
    double largest = 0.0;
    const auto ground = [](double t) { return 0.5 * std::sin(2.0 * kPi * 1.5 * t); };
    while (s.state.time < 1.0) {
      advance(s, {ground(s.state.time), ground(s.state.time + s.dt)});
      for (const Stress<2>& x : s.state.stress) largest = std::max(largest, std::abs(x[3]));
    }
    return largest;
  };
  const double strong = most(1e9);
  CHECK(strong > 15e3);                           // control: what the ground asks for
  CHECK(most(5e3) == Approx(5e3).epsilon(1e-3));  // sigma_zz starts 2 % off the mean of the plane
}
