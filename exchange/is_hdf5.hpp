#pragma once
#include <filesystem>

namespace flowslide {

/// Does a file begin as HDF5 files do? FileError with the system's reason if it cannot be read.
bool is_hdf5(const std::filesystem::path& path);

}  // namespace flowslide
