#pragma once
#include <cstddef>

namespace flowslide::mpm {

/// Memory bandwidth of one core by the triad a = b + s c on arrays of `bytes` in all, counted as
/// two loads and a store; the best of several passes [B/s].
double triad_bandwidth(std::size_t bytes);

}  // namespace flowslide::mpm
