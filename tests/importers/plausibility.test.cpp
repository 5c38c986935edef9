#include "importers/plausibility.hpp"

#include "core/check.hpp"
#include "importers/weight_check.hpp"

#include <cmath>
#include <functional>

#include <catch2/catch.hpp>
#include <fmt/format.h>

/// Recorded states against themselves: strains against displacements, stress against weight.
using namespace flowslide;
using Catch::Contains;

namespace {

constexpr double kWater = 9810.0;  // [N/m3]

/// 40 m wide and 20 m deep, in elements of 4 m by 2 m, with the surface at y = 20 m.
QuadMesh layer() {
  QuadMesh m;
  for (int j = 0; j <= 10; ++j)
    for (int i = 0; i <= 10; ++i) {
      m.nodes.push_back({4.0 * i, 2.0 * j});
      m.node_tags.push_back(std::ssize(m.node_tags) + 1);
    }
  for (std::int32_t j = 0; j < 10; ++j)
    for (std::int32_t i = 0; i < 10; ++i) {
      const std::int32_t n = 11 * j + i;
      m.elements.push_back({n, n + 1, n + 12, n + 11});
      m.element_tags.push_back(std::ssize(m.element_tags) + 1);
      m.element_material.push_back(1);
    }
  return m;
}

/// At rest under soil of 1900 kg/m3 and a pond 3 m deep, with K0 = 0.5.
FemFrame at_rest(const QuadMesh& mesh) {
  FemFrame f;
  f.displacement.assign(mesh.num_nodes(), {0.0, 0.0});
  f.velocity = f.displacement;
  for (const Vec2& p : mesh.nodes) f.pore_pressure.push_back(kWater * (23.0 - p[1]));
  for (std::size_t e = 0; e < mesh.num_elements(); ++e) {
    const double depth = 20.0 - centroid(corners(mesh, mesh.nodes, e))[1];
    const double s = (1900.0 * 9.81 - kWater) * depth;
    f.stress.push_back({-0.5 * s, -s, -0.5 * s, 0.0});
  }
  f.strain.assign(mesh.num_elements(), {});
  return f;
}

std::string weighed(const std::function<void(FemFrame&)>& change, double density = 1900.0,
                    double unit = 1e3) {
  const QuadMesh mesh = layer();
  FemFrame f = at_rest(mesh);
  change(f);
  return weight_warning(mesh, {{"sand", 1, density}}, f, unit);
}

void scale_stress(FemFrame& f, double stress, double pressure) {
  for (Stress<2>& s : f.stress)
    for (int i = 0; i < 4; ++i) s[i] *= stress;
  for (double& u : f.pore_pressure) u *= pressure;
}

/// Displacements that grow with time, with strains as `record` changes them, and themselves as
/// `move` does.
std::string strained(
    const std::function<void(StrainIncrement<2>&)>& record,
    const std::function<void(Vec2&)>& move = [](Vec2&) {}, double size = 1.0) {
  const QuadMesh mesh = layer();
  StrainWatch watch(mesh);
  for (int t = 0; t < 4; ++t) {
    FemFrame f = at_rest(mesh);
    for (std::size_t n = 0; n < mesh.num_nodes(); ++n) {
      const auto [x, y] = mesh.nodes[n];
      const double a = size * 1e-2 * t;
      f.displacement[n] = {0.3 + a * (std::sin(0.2 * x) + 0.1 * y),
                           a * std::cos(0.3 * y + 0.1 * x)};
    }
    for (std::size_t e = 0; e < mesh.num_elements(); ++e) {
      // The mean over the sides of a rectangle is what its centre has.
      const auto& k = mesh.elements[e];
      const auto u = [&](int i) { return f.displacement[k[i]]; };
      const auto slope = [&](int d, bool along_x) {
        return along_x ? 0.5 * (u(1)[d] - u(0)[d] + u(2)[d] - u(3)[d]) / 4.0
                       : 0.5 * (u(3)[d] - u(0)[d] + u(2)[d] - u(1)[d]) / 2.0;
      };
      f.strain[e] = {slope(0, true), slope(1, false), 0.0, slope(0, false) + slope(1, true)};
      record(f.strain[e]);
    }
    for (Vec2& v : f.displacement) move(v);
    watch.look_at(f);
  }
  return watch.warning();
}

}  // namespace

TEST_CASE("Stress of soil at rest carries the weight above, or the warning says what would fit") {
  CHECK(weighed([](FemFrame&) {}).empty());
  CHECK_THAT(weighed([](FemFrame& f) { scale_stress(f, 1e3, 1e3); }),
             Contains("1e+03 times the weight") && Contains("`units.stress` is Pa"));
  CHECK_THAT(weighed([](FemFrame& f) { scale_stress(f, 1e-3, 1e-3); }),
             Contains("`units.stress` is MPa"));
  CHECK_THAT(weighed([](FemFrame& f) { scale_stress(f, 1.0 / 6.89476, 1.0 / 6.89476); }),
             Contains("`units.stress` is psi"));
  CHECK_THAT(
      weighed([](FemFrame& f) { scale_stress(f, 1.0, -1.0); }),
      Contains("sign of the pore pressure is changed (compression is positive) (1.00 times"));
  CHECK_THAT(weighed([](FemFrame& f) { scale_stress(f, -1.0, 1.0); }),
             Contains("sign of the stress is changed (tension is positive) (1.00 times"));
  CHECK_THAT(weighed([](FemFrame& f) { scale_stress(f, -1.0, -1.0); }),
             Contains("signs of stress and pore pressure are changed (1.00 times"));
  CHECK_THAT(weighed([](FemFrame& f) {
               for (std::size_t e = 0; e < f.stress.size(); ++e) {
                 const double depth = -f.stress[e][1] / (1900.0 * 9.81 - kWater);
                 for (int i = 0; i < 3; ++i) f.stress[e][i] -= kWater * (depth + 3.0);
               }
             }),
             Contains("the stress is a total one"));
  CHECK_THAT(weighed([](FemFrame& f) {
               for (Stress<2>& s : f.stress) std::swap(s[0], s[1]);
             }),
             Contains("read as xx is the vertical one"));
}

TEST_CASE("A density that the stress at rest does not have is named with the right one") {
  CHECK(weighed([](FemFrame&) {}, 2000.0).empty());
  CHECK_THAT(weighed([](FemFrame&) {}, 1500.0),
             Contains("1.27 times the weight") && Contains("are 1.27 times those given"));
  CHECK_THAT(weighed([](FemFrame&) {}, 2700.0), Contains("are 0.70 times those given"));
}

TEST_CASE("A column that fits by chance is not offered", "[importers]") {
  // with K0 = 0.5 everywhere xx is 0.97 times the weight in every element, with others in the
  // median
  const auto other_k0 = [](FemFrame& f) {
    for (std::size_t e = 0; e < f.stress.size(); ++e)
      f.stress[e][0] *= 0.6 + 0.8 / 9.0 * static_cast<double>(e % 10);
  };
  CHECK_THAT(weighed([](FemFrame&) {}, 1500.0), Contains("read as xx is the vertical one"));
  CHECK_THAT(weighed(other_k0, 1500.0), Contains("are 1.27 times those given") && !Contains("xx"));
}

TEST_CASE("Strains that are not those of the displacements are told by column") {
  CHECK(strained([](auto&) {}).empty());
  CHECK_THAT(strained([](auto& e) { std::swap(e[0], e[1]); }),
             Contains("xx is 1 times yy; yy is 1 times xx; xy is 1 times xy"));
  CHECK_THAT(strained([](auto& e) {
               e = {e[0], e[3], 0.0, e[1]};
             }),
             Contains("xx is 1 times xx; yy is 1 times xy; xy is 1 times yy"));
  CHECK_THAT(strained([](auto& e) { e[3] *= 0.5; }),
             Contains("xy is 0.5 times xy") && Contains("tensor's shear strain"));
  CHECK_THAT(strained([](auto& e) {
               e = {-e[0], -e[1], 0.0, -e[3]};
             }),
             Contains("xx is -1 times xx; yy is -1 times yy"));
  CHECK_THAT(strained([](auto& e) {
               e = {1e2 * e[0], 1e2 * e[1], 0.0, 1e2 * e[3]};
             }),
             Contains("xx is 100 times xx") && Contains("not per cent"));
  CHECK_THAT(strained([](auto&) {}, [](Vec2& u) { std::swap(u[0], u[1]); }),
             Contains("components are exchanged"));
  CHECK_THAT(strained([](auto& e) { e = {1e-4, -1e-4, 0.0, 2e-4}; }), Contains("follows none"));
}

TEST_CASE("Strains below the rounding of displacements are not judged") {
  CHECK(strained([](auto& e) { std::swap(e[0], e[1]); }, [](Vec2&) {}, 1e-3).empty());
}
