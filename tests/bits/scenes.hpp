#pragma once
#include <filesystem>
#include <string>
#include <vector>

/// What has to have the same bits on every processor and for any number of threads. Each part gives
/// lines of a name and a digest.
namespace flowslide::same_bits {

struct Line {
  std::string name, digest;
};
using Lines = std::vector<Line>;

Lines functions();        ///< of core/elementary.hpp
Lines motions();          ///< presets, filters, resampling
Lines laws(int threads);  ///< blocks that collapse, one for every law, in two and three dimensions
Lines schemes(int threads);  ///< the same for every shape function, transfer and update
Lines chain(int threads);    ///< chain.yaml stage by stage, with explicit and implicit steps

}  // namespace flowslide::same_bits
