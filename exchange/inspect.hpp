#pragma once
#include "workflows/engine/sealed_json.hpp"

#include <filesystem>
#include <functional>

namespace flowslide {

/// What a file or the folder of a run is and holds, as a JSON object: "kind", counts, ranges, and
/// under "problems" what is wrong with it. Knows the files that this program writes, workflows,
/// earthquake records that say what they are, terrain, and tables of numbers. Throws InputError for
/// anything else, FileError. `tick` learns how much of what is long has been read, from 0 to 1.
Json inspect(const std::filesystem::path& path, const std::function<void(double)>& tick = {});

}  // namespace flowslide
