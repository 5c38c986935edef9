#pragma once
#include <array>
#include <filesystem>
#include <limits>
#include <span>
#include <string>
#include <vector>

/// The ground in three dimensions as heights on a regular grid. docs/theory/contact.md
namespace flowslide::mpm {

/// Where the scene lies on the map of a height field: the scene's origin in map coordinates, the
/// direction of its x axis and the map height that is its z = 0.
struct MapPlace {
  std::array<double, 2> origin{};  ///< [m]
  double heading = 0.0;            ///< of x, counter-clockwise from the map's first axis [rad]
  double level = 0.0;              ///< [m]
};

/// Bilinear between the nodes of the grid, level beyond its edges.
struct HeightField {
  std::array<double, 2> corner{};  ///< map coordinates of the first node [m]
  double spacing = 1.0;            ///< [m]
  int columns = 0, rows = 0;
  std::vector<double> height;  ///< [m], row by row from the lowest second coordinate; NaN: no data
  MapPlace place;
  bool complete = true;  ///< no NaN
  std::string source;    ///< file, for messages
  int first_line = 0;    ///< of the file with heights, which begins with the last row

  /// Height of the ground in the scene [m]; NaN where a node around has no data.
  [[nodiscard]] double at(double x, double y) const;
  /// "FILE:LINE (row, column)" of the nodes around a place of the scene without data.
  [[nodiscard]] std::string name_place(double x, double y) const;
};

/// Reads an ESRI ASCII grid (ncols, nrows, xllcorner or xllcenter, likewise y, cellsize,
/// nodata_value; one line per row from north to south). Throws InputError with file:line,
/// FileError.
HeightField read_height_field(const std::filesystem::path& path, const MapPlace& place);

/// Throws NumericsError if a point stands where there are no data.
void check_covered(const HeightField& field, std::span<const double> x, std::span<const double> y,
                   double time);

}  // namespace flowslide::mpm
