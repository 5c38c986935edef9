#pragma once
#include "workflows/engine/sealed_json.hpp"

#include <filesystem>
#include <functional>

namespace flowslide {

/// What a run folder stands for. Reads every byte of every result in it; "problems" names each file
/// that is not as it was written. InputError if it is no run folder, FileError. `tick` learns
/// what share of the bytes has been read.
Json inspect_run(const std::filesystem::path& folder, const std::function<void(double)>& tick = {});

}  // namespace flowslide
