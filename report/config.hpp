#pragma once
#include "config/schema.hpp"

#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace flowslide {

/// A part of the undeformed section whose movement is reported by name, such as "lower dam".
struct ReportRegion {
  std::vector<std::vector<double>> outline;  ///< corners x, y [m] in order around the region
};

struct ReportConfig {
  std::string title = "Runout of the section";
  std::optional<double> toe;       ///< x of the toe of the undeformed section [m]
  double moved = 1.0;              ///< displacement from which a point counts as failed [m]
  double stood = 0.1;              ///< largest displacement of a section that stood [m]
  double flow_reach = 1.0;         ///< flowed: farthest displacement of the flow / height [-]
  std::optional<double> pond;      ///< level of the pond, for the freeboard left [m]
  double mass_quantile = 0.005;    ///< share of the failed mass beyond the robust front [-]
  double energy_warning = 0.05;    ///< largest silent residual of the energy balance [-]
  double momentum_warning = 0.05;  ///< largest silent residual of the impulse balance [-]
  double mass_warning = 1e-9;      ///< largest silent relative error of mass [-]
  std::map<std::string, ReportRegion> regions;
  bool figures = true;
  bool page = true;
  int page_points = 40000;
  int page_frames = 48;
  bool paraview = true;
  std::optional<std::string> python;  ///< interpreter of the figures; found by itself if empty
};

template <>
struct Schema<ReportRegion> {
  static constexpr std::string_view doc = "A named part of the undeformed section.";
  static void describe(FieldVisitor& v, ReportRegion& c) {
    static constexpr std::array columns{FieldVisitor::Column{"x", Dim::length},
                                        FieldVisitor::Column{"y", Dim::length}};
    v.rows("outline", c.outline, columns, "corners in order around the region, three or more");
  }
};

template <>
struct Schema<ReportConfig> {
  static constexpr std::string_view doc = "What the report says and draws.";
  static void describe(FieldVisitor& v, ReportConfig& c) {
    v.text("title", c.title, "first line of the report");
    v.quantity("toe", c.toe, Dim::length, {},
               "x from which the runout counts; left out: the downstream end of the soil that "
               "counts, before deformation");
    v.quantity("moved", c.moved, Dim::length, {.above = 0.0},
               "displacement from which a material point counts as failed");
    v.quantity("stood", c.stood, Dim::length, {.above = 0.0},
               "the section stood if less than 0.5 % of its mass moved farther, it deformed if "
               "less moved farther than `moved`");
    v.quantity("flow_reach", c.flow_reach, Dim::none, {.above = 0.0},
               "it flowed if 0.5 % of the mass moved farther after the transfer than this many "
               "heights of the section; else it slid");
    v.quantity("pond", c.pond, Dim::length, {},
               "level of the pond; left out: no freeboard is told");
    v.quantity("mass_quantile", c.mass_quantile, Dim::none, {.above = 0.0, .below = 0.5},
               "share of the failed mass that lies beyond the robust front");
    for (const char* key : {"rest_kinetic", "rest_front", "rest_window"})
      v.moved(
          key,
          "(the rule of rest comes with the runout) remove it, and write 'rest: {kinetic_share: "
          "0.001, runout_change: 0.2 m, window: 5 s}' in mpm.run");
    v.quantity("energy_warning", c.energy_warning, Dim::none, {.above = 0.0},
               "residual of the energy balance from which the report warns");
    v.quantity("momentum_warning", c.momentum_warning, Dim::none, {.above = 0.0},
               "residual of the impulse balance from which the report warns");
    v.quantity("mass_warning", c.mass_warning, Dim::none, {.above = 0.0},
               "relative error of mass from which the report warns");
    v.moved("liquefied", "(the points know which of them had liquefied) remove it");
    v.table("regions", c.regions, "parts of the undeformed section to report by name");
    v.flag("figures", c.figures, "draw the figures (needs python3 with matplotlib)");
    v.flag("page", c.page, "write report.html, the interactive page of the run");
    v.integer("page_points", c.page_points, {.min = 100.0, .max = 1e6},
              "most points of its player; of more, an even choice is shown");
    v.integer("page_frames", c.page_frames, {.min = 2.0, .max = 1000.0},
              "most instants of its player; of more, those are chosen that let the fastest point "
              "come equally far between two");
    v.flag("paraview", c.paraview, "write flow.pvd and zone.pvd for ParaView");
    v.text("python", c.python,
           "interpreter that draws the figures, to be allowed with --allow-python; left out: the "
           "first found");
  }
};

}  // namespace flowslide
