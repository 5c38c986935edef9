#pragma once
#include "workflows/engine/sealed_json.hpp"

#include <filesystem>

namespace flowslide {

/// Whether the first lines of a file say that it is an earthquake record. Throws FileError.
bool is_motion_record(const std::filesystem::path& path);

/// See inspect(). A record that cannot be read says why under "problems"; what is odd about one
/// that can, under "warnings".
Json inspect_record(const std::filesystem::path& path);

}  // namespace flowslide
