#pragma once
#include "core/check.hpp"
#include "model/history.hpp"
#include "model/mpm_history.hpp"
#include "model/zone.hpp"
#include "tests/support/materials.hpp"

#include <algorithm>
#include <cmath>

/// A dam of the shape of the case study on a coarse mesh, and a flow with a prescribed shape, so
/// that every number of the report is known beforehand. Lengths in m.
namespace flowslide::dam_case {

inline constexpr double kToe = 75.0;
inline constexpr double kSlip = 12.0;  ///< points above it move by `shift`
inline constexpr double kMesh = 5.0;
inline constexpr double kSpacing = 1.25;

/// Surface before the earthquake: pond at 30, downstream face, a step of 1 m at the toe.
inline double surface(double x) {
  if (x <= -20.0) return 30.0;
  return x < kToe ? 1.0 + 29.0 * (kToe - x) / (kToe + 20.0) : 0.0;
}

/// 1 foundation, 2 embankment, 3 tailings; the upstream faces of the lower and the upper dam.
inline int soil(double x, double y) {
  if (y < 0.0) return 1;
  return x < (y < 12.5 ? 1.6 * y : 17.42 - 3.167 * (y - 12.5)) ? 3 : 2;
}

inline QuadMesh mesh() {
  QuadMesh m;
  constexpr int rows = 7;
  const int columns = static_cast<int>(std::lround((kToe + 10.0 + 140.0) / kMesh));
  const auto node = [&](int i, int j) {
    const double x = -140.0 + kMesh * i;
    const double top = std::max(surface(std::min(x, kToe - 1e-9)), 1.0);
    return Vec2{x, j == 0 ? -5.0 : top * (j - 1) / (rows - 1)};
  };
  for (int i = 0; i <= columns; ++i)
    for (int j = 0; j <= rows; ++j) {
      m.nodes.push_back(node(i, j));
      m.node_tags.push_back(static_cast<std::int64_t>(m.nodes.size()));
    }
  for (int i = 0; i < columns; ++i)
    for (int j = 0; j < rows; ++j) {
      if (j > 0 && node(i, 0)[0] >= kToe) continue;
      const int a = i * (rows + 1) + j;
      m.elements.push_back({a, a + rows + 1, a + rows + 2, a + 1});
      m.element_tags.push_back(static_cast<std::int64_t>(m.elements.size()));
      const Vec2 c =
          centroid({m.nodes[a], m.nodes[a + rows + 1], m.nodes[a + rows + 2], m.nodes[a + 1]});
      m.element_material.push_back(soil(c[0], c[1]));
    }
  return m;
}

inline FemFrame rest(const QuadMesh& m) {
  FemFrame f;
  f.displacement.resize(m.num_nodes());
  f.velocity.resize(m.num_nodes());
  for (const Vec2& n : m.nodes) {
    const double water = std::min(30.0, 18.427 - 0.303 * n[0]);
    f.pore_pressure.push_back(9810.0 * std::max(0.0, water - n[1]));
  }
  f.stress.resize(m.num_elements());
  f.strain.resize(m.num_elements());
  return f;
}

/// The state at rest and, if shaken, four frames at 0, 1, 2 and 3 s.
inline void write_history(const std::filesystem::path& path, bool shaken) {
  const QuadMesh m = mesh();
  FemFrame frame = rest(m);
  FemHistoryWriter out(path, m, test::materials_of(m),
                       {.program = "a shaking table", .sigma_zz_rule = "given", .notes = {}});
  out.set_gravity(frame);
  for (int k = 0; shaken && k < 4; ++k) {
    frame.time = k;
    out.append(frame);
  }
  out.finish();
}

inline LiquefactionZone zone(const QuadMesh& m, bool shaken) {
  LiquefactionZone z;
  z.transfer_time = shaken ? 2.0 : 0.0;
  z.transfer_frame = shaken ? 2 : -1;
  z.transfer_reason = shaken ? "halfway between full failure and excessive distortion"
                             : "the state at rest was asked for";
  z.r_u_node.assign(m.num_nodes(), shaken ? 0.8 : kUnset);
  for (std::size_t e = 0; e < m.num_elements(); ++e) {
    const Vec2 c = centroid(corners(m, m.nodes, e));
    const double depth = surface(c[0]) - c[1];
    const bool liquefied = m.element_material[e] == 3 && depth < 18.0;
    z.r_u_element.push_back(shaken ? 1.0 - depth / 60.0 : kUnset);
    z.sigma_v0.push_back(8490.0 * depth);
    z.liquefied.push_back(liquefied);
    z.layer.push_back(liquefied ? static_cast<int>(depth / 6.0) : -1);
    z.strength.push_back(liquefied ? 3000.0 + 2000.0 * z.layer.back() : kUnset);
  }
  z.lower_boundary = {{-140.0, 12.0}, {-20.0, 12.0}, {14.0, 9.0}};
  z.window_names = {"crest", "pond"};
  z.window_depth_max = {14.0, 18.0};
  z.window_depth_any = {20.0, 21.0};
  z.window_depth_interpolated = {14.5, 18.5};
  z.window_depth_strong = {9.0, 11.0};
  z.window_depth_before_slide = {12.0, 13.0};
  if (!shaken) return z;
  ZoneHistory& h = z.history;
  h.window_names = z.window_names;
  h.depth.resize(2);
  h.depth_max.resize(2);
  for (int i = 0; i < 4; ++i) {
    h.time.push_back(i);
    for (int w = 0; w < 2; ++w) {
      h.depth[w].push_back(4.0 * i + w);
      h.depth_max[w].push_back(5.0 * i + w);
    }
    h.kinetic_energy.push_back(2e5 * i);
    h.sliding_energy.push_back(1e4 * i);
    h.kinetic_energy_relative.push_back(1e5 * i);
    h.distortion_gauss.push_back(1.0 - 0.01 * i);
    h.distortion_centre.push_back(1.0);
  }
  h.depth_any = h.depth_interpolated = h.depth;
  z.strong_shaking_end = 1.0;
  z.onset_time = 2.0;
  z.notes = {"3 nodes near the pond surface were skipped"};
  return z;
}

/// The rule of rest of the flow.
inline constexpr RestRule kRest{};

inline ParticleSet particles() {
  ParticleSet p;
  p.toe = kToe;
  p.materials = {
      {.name = "foundation", .law = "linear_elastic", .parameters = {}, .counts_for_runout = false},
      {.name = "embankment", .law = "mohr_coulomb", .parameters = {}},
      {.name = "tailings", .law = "mohr_coulomb", .parameters = {}},
      {.name = "liquefied 1",
       .law = "residual_strength",
       .parameters = {},
       .counts_for_runout = true,
       .liquefied = true}};
  for (double x = -140.0 + 0.5 * kSpacing; x < kToe + 10.0; x += kSpacing)
    for (double y = -5.0 + 0.5 * kSpacing; y < surface(x); y += kSpacing) {
      const int s = soil(x, y) - 1;
      p.position.push_back({x, y, 0.0});
      p.material.push_back(s == 2 && y > kSlip ? 3 : s);
      p.id.push_back(static_cast<std::int64_t>(p.id.size()));
    }
  const std::size_t n = p.size();
  p.velocity.resize(n);
  p.displacement.resize(n);
  p.stress.resize(n);
  p.pore_pressure.assign(n, 0.0);
  p.volume.assign(n, kSpacing * kSpacing);
  p.mass.assign(n, 1870.0 * kSpacing * kSpacing);
  return p;
}

/// Points of x > -100 above the slip level move so that x = 40 comes to x = `front`.
inline std::array<double, 3> flowed(const std::array<double, 3>& x, double front, double share) {
  if (x[1] < kSlip || x[0] < -100.0) return x;
  const double stretch = (x[0] + 100.0) / 140.0;
  const double to = x[0] + share * (front - 40.0) * stretch * stretch;
  const double base = to < 20.0 ? kSlip : std::max(0.0, kSlip - (to - 20.0) * kSlip / 55.0);
  const double y = (1.0 - share) * x[1] + share * (base + (x[1] - kSlip) * (0.6 - 0.5 * stretch));
  return {to, std::max(y, base), 0.0};
}

struct Flow {
  double front = 200.0;  ///< of the points that start at x = 40; the top of the dam stays behind
  double end = 40.0;     ///< [s]; at rest from 30 s on
  double fall = 0.0;     ///< of the valley beyond the toe, which the points follow [-]
};

/// Writes the history of a flow whose frames follow `flowed`; samples repeat the definition of the
/// front by an independent sort.
inline void write_flow(const std::filesystem::path& path, const ParticleSet& p, const Flow& flow) {
  MpmHistoryWriter out(path, p, kRest);
  const auto frame = [&](double time) {
    MpmFrame f;
    f.time = time;
    const double share = std::min(1.0, time / 30.0);
    for (std::size_t i = 0; i < p.size(); ++i) {
      f.position.push_back(flowed(p.position[i], flow.front, share));
      f.position.back()[1] -= flow.fall * std::max(0.0, f.position.back()[0] - kToe);
      f.strength.push_back(p.material[i] == 0 ? kUnset : 5000.0 * (1.0 - 0.5 * share));
    }
    f.velocity.resize(p.size());
    f.stress.resize(p.size());
    f.volume = p.volume;
    f.plastic_strain.assign(p.size(), 0.0);
    return f;
  };
  for (double time : {0.0, 0.5 * flow.end, flow.end}) out.append(frame(time));
  for (int k = 0; k <= 40; ++k) {
    const double time = flow.end * k / 40.0;
    const MpmFrame f = frame(time);
    std::vector<double> x;
    for (std::size_t i = 0; i < p.size(); ++i)
      if (p.material[i] != 0) x.push_back(f.position[i][0]);
    std::sort(x.begin(), x.end());
    MpmSample s;
    s.time = time;
    s.front = x[x.size() - 5];
    s.runout = std::max(0.0, s.front - kToe);
    s.kinetic = time < 30.0 ? 1e6 * std::sin(3.14159265 * time / 30.0) : 0.0;
    s.gravity_work = 1e7 * std::min(1.0, time / 30.0);
    s.plastic_work = 0.7 * (s.gravity_work - s.kinetic);
    s.friction_work = 0.3 * (s.gravity_work - s.kinetic);
    s.energy_error = 0.01;
    s.momentum_error = -0.002;
    s.max_speed = time < 30.0 ? 12.0 : 0.0;
    s.dt = 1e-3;
    s.active_particles = 1.0;
    out.append(s);
  }
  out.finish();
}

}  // namespace flowslide::dam_case
