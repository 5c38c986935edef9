#pragma once
#include "model/mesh.hpp"
#include "report/plot_runner.hpp"

#include <array>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <vector>

/// Picture of a section as a workflow describes it, before anything runs.
namespace flowslide {

struct PlottedWindow {
  std::string name;
  double from = -std::numeric_limits<double>::infinity();  ///< x [m]
  double to = std::numeric_limits<double>::infinity();     ///< x [m]
};

struct PlottedSoil {
  int tag = 0;  ///< as in QuadMesh::element_material
  std::string name;
};

struct WorkflowPlot {
  std::string title;
  std::vector<PlottedSoil> soils;
  std::vector<PlottedWindow> windows;        ///< in which depths are read
  std::vector<Vec2> water;                   ///< water table and pond, from left to right [m]
  std::vector<Vec2> ground;                  ///< of the flow, from left to right [m]
  std::optional<std::array<double, 4>> box;  ///< left, right, bottom, top of what can flow [m]
  std::optional<double> toe;                 ///< where the runout begins, x [m]
};

/// Draws a PNG, SVG or PDF, as the ending of `out` says; replaces what was there. Throws
/// InputError for other endings, NumericsError if it cannot be drawn, FileError, Interrupted.
void draw_workflow(const WorkflowPlot& plot, const QuadMesh& mesh, const std::filesystem::path& out,
                   const std::optional<std::string>& python, const Progress& progress);

}  // namespace flowslide
