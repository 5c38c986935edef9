#include "core/conventions.hpp"
#include "section/slip_search.hpp"
#include "verify/section/list.hpp"

#include <algorithm>
#include <cmath>

namespace flowslide::section {
namespace {

/// The dam of workflows/mochikoshi.yaml with its tailings liquefied to a depth below the pond.
SlopeModel dam(double liquefied_depth) {
  const SlopeSoil foundation{.name = "foundation",
                             .unit_weight = 18.6e3,
                             .cohesion = 5e3,
                             .friction = 40.0 * kDegree,
                             .r_u = {},
                             .residual = {}};
  const SlopeSoil embankment{.name = "embankment",
                             .unit_weight = 16.6e3,
                             .cohesion = 20e3,
                             .friction = 35.0 * kDegree,
                             .r_u = {},
                             .residual = {}};
  SlopeSoil tailings{.name = "tailings",
                     .unit_weight = 18.3e3,
                     .cohesion = 1e3,
                     .friction = 30.0 * kDegree,
                     .r_u = {},
                     .residual = {}};
  SlopeModel m;
  m.soils = {foundation, embankment, tailings};
  tailings.name = "liquefied tailings";
  tailings.residual = {{25e3, 3.0e3},   {50e3, 4.3e3},  {75e3, 5.6e3},   {100e3, 6.5e3},
                       {125e3, 7.4e3},  {175e3, 9.1e3}, {225e3, 10.6e3}, {250e3, 11.1e3},
                       {275e3, 11.5e3}, {325e3, 12.0e3}};
  m.soils.push_back(tailings);
  const std::vector<Vec2> pond = {{-340.0, 0.0}, {0.0, 0.0},    {20.0, 12.5},
                                  {17.42, 12.5}, {-38.0, 30.0}, {-340.0, 30.0}};
  m.zones = {
      {0, {{-340.0, -5.0}, {87.5, -5.0}, {87.5, 0.0}, {-340.0, 0.0}}},
      {1, {{0.0, 0.0}, {75.0, 0.0}, {35.42, 12.5}, {20.0, 12.5}}},
      {1, {{17.42, 12.5}, {20.0, 12.5}, {35.42, 12.5}, {-20.0, 30.0}, {-38.0, 30.0}}},
      {2, pond},
  };
  if (liquefied_depth > 0.0) m.zones.push_back({3, above_level(pond, 30.0 - liquefied_depth)});
  m.ground = {{-340.0, 30.0}, {-20.0, 30.0}, {35.42, 12.5}, {75.0, 0.0}, {87.5, 0.0}};
  m.water_table = {{-340.0, 30.0}, {-38.2, 30.0}, {60.8, 0.0}, {87.5, 0.0}};
  return m;
}

double factor_at(double depth) {
  const SlipSearch search{.entry = {-120.0, -21.0},
                          .exit = {-15.0, 87.0},
                          .floor = -5.0,
                          .slice_width = 2.0,
                          .points = 6};
  return search_surfaces(dam(depth), search, {30.0 - depth, 30.3 - depth, 12.5, 12.6}).factor;
}

}  // namespace

/// Sordo, Rathje & Kumar (2025) state factors of 1.0 for tailings liquefied to 12 m and 0.5 for
/// 18.5 m and deeper. The other depths were searched at random with surfaces of three legs and
/// forces between slices at 8 degrees (scatter 0.05): for strong soil the same is expected, and for
/// weak layers, which three legs follow badly, no more than that.
std::vector<Check> verify_mochikoshi(std::string_view name) {
  CheckList list(name);
  list.near("factor_depth_0", factor_at(0.0), 1.78, 0.05);
  list.near("factor_depth_8", factor_at(8.0), 1.74, 0.05);
  list.near("factor_depth_12", factor_at(12.0), 1.0, 0.1);
  const double plateau = factor_at(18.5);
  list.near("factor_depth_18.5", plateau, 0.5, 0.07);
  const double share = factor_at(30.0) / plateau;
  list.at_least("factor_30_over_18.5", share, 0.85);
  list.at_most("factor_30_over_18.5_upper", share, 1.0);
  for (const auto& [depth, most] : {std::pair{10.0, 1.51},
                                    {11.0, 1.20},
                                    {13.0, 0.94},
                                    {14.0, 0.84},
                                    {16.0, 0.70},
                                    {22.0, 0.51}})
    list.at_most(fmt::format("factor_depth_{:.0f}", depth), factor_at(depth), most + 0.05);
  return list.take();
}

}  // namespace flowslide::section
