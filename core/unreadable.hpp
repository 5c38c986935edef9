#pragma once
#include <filesystem>
#include <string>

namespace flowslide {

/// Why a file that a user names cannot be read, with what to do: no such file (and which folder of
/// its path is the first that is missing, and which name there is near to it), '~', a folder, no
/// permission, a loop of links, a name too long. Empty if it can be.
std::string why_unreadable(const std::filesystem::path& path);

}  // namespace flowslide
