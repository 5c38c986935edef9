#pragma once
#include "model/ground_motion.hpp"

#include <filesystem>
#include <string>

namespace flowslide {

/// CSV with a comment for the origin, a heading, and rows of time [s] and acceleration [m/s2] in
/// digits that read back to the same numbers.
std::string motion_csv(const GroundMotion& motion);

/// motion_csv as a file. Throws FileError.
void write_motion(const std::filesystem::path& path, const GroundMotion& motion);

}  // namespace flowslide
