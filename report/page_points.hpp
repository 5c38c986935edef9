#pragma once
#include "model/mpm_history.hpp"
#include "report/page_arrays.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

/// The points of a runout for the player of the page.
namespace flowslide {

/// Indices of at most `most` of the frames, the first and the last among them, such that the
/// fastest point of the time series comes about equally far between two of them; a quarter of the
/// weight is time, so that the slow end is not left out.
std::vector<std::size_t> choose_frames(const std::vector<double>& times,
                                       const std::vector<MpmSample>& samples, std::size_t most);

/// At most `most` points, spread evenly over the section, neighbours near each other; `always` are
/// among them.
std::vector<std::size_t> choose_points(const std::vector<std::array<double, 3>>& undeformed,
                                       const std::vector<std::size_t>& always, std::size_t most);

struct ShownPoints {
  std::size_t points = 0, frames = 0;  ///< in the page
  double spacing = 0.0;                ///< edge of the square a point stands for [m]
};

/// Adds points.t, .x, .y, .x0, .y0, .material, .speed (its square root), .strength (ratio to that
/// at transfer).
ShownPoints add_points(PageArrays& arrays, const MpmHistory& flow,
                       const std::vector<std::array<double, 3>>& undeformed,
                       std::size_t most_points, std::size_t most_frames);

}  // namespace flowslide
