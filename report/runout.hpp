#pragma once
#include "model/front.hpp"

#include <array>
#include <cstdint>
#include <span>

/// Where a flow ends. The definition is that of the case study this program follows (Sordo, Rathje
/// and Kumar 2025, Soil Dyn. Earthq. Eng. 194, 109371): "fifth-farthest material point from the
/// toe". `counts` is 1 for points of materials that take part (all but the foundation).
namespace flowslide {

/// x of the fifth-farthest counted point [m]. Throws InputError if there are fewer than five, if
/// the arrays differ in length or if a position is not finite.
double front_position(std::span<const std::array<double, 3>> positions,
                      std::span<const std::uint8_t> counts);

/// max(0, front_position - toe) [m].
double runout(std::span<const std::array<double, 3>> positions,
              std::span<const std::uint8_t> counts, double toe);

/// x beyond which at most `share` (0 to 1) of the counted mass lies [m]: unlike the fifth-farthest
/// point it does not depend on the number of points. Positive masses [kg]; at least one counted
/// point. Throws InputError.
double front_quantile(std::span<const std::array<double, 3>> positions,
                      std::span<const std::uint8_t> counts, std::span<const double> mass,
                      double share);

}  // namespace flowslide
