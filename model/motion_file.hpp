#pragma once
#include "model/ground_motion.hpp"

#include <filesystem>

/// A ground motion between stages. On disk: HDF5, kind "motion".
namespace flowslide {

/// Throws InputError as check(const GroundMotion&), FileError.
void write_motion_file(const std::filesystem::path& path, const GroundMotion& motion);
GroundMotion read_motion_file(const std::filesystem::path& path);

}  // namespace flowslide
