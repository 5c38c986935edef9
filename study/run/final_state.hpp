#pragma once
#include <filesystem>

namespace flowslide::study {

/// Where the points of a runout are at its start and at its end, to a millimetre, and its time
/// series: HDF5, kind "mpm_final", about a hundredth of the frames. Throws FileError.
void write_final_state(const std::filesystem::path& mpm_history, const std::filesystem::path& to);

}  // namespace flowslide::study
