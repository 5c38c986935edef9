#pragma once
#include "workflows/engine/sealed_json.hpp"

#include <filesystem>

namespace flowslide {

/// Whether the first lines of a file say that it is an earthquake record. Throws FileError.
bool is_motion_record(const std::filesystem::path& path);

/// See inspect(). What cannot be read without being told more stands under "problems".
Json inspect_record(const std::filesystem::path& path);

}  // namespace flowslide
