#pragma once
#include "workflows/engine/sealed_json.hpp"

#include <filesystem>

namespace flowslide {

/// What a run folder stands for. Reads every byte of every result in it; "problems" names each file
/// that is not as it was written. InputError if it is no run folder, FileError.
Json inspect_run(const std::filesystem::path& folder);

}  // namespace flowslide
