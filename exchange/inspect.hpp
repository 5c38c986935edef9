#pragma once
#include "workflows/engine/sealed_json.hpp"

#include <filesystem>

namespace flowslide {

/// What a file or the folder of a run is and holds, as a JSON object: "kind", counts, ranges, and
/// under "problems" what is wrong with it. Knows the files that this program writes, workflows,
/// earthquake records that say what they are, terrain, and tables of numbers. Throws InputError for
/// anything else, FileError.
Json inspect(const std::filesystem::path& path);

}  // namespace flowslide
