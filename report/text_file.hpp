#pragma once
#include <filesystem>
#include <string_view>

namespace flowslide {

/// Writes the bytes to `path`.partial and renames it, so that a file under its final name is
/// complete. Throws FileError.
void write_file(const std::filesystem::path& path, std::string_view bytes);

}  // namespace flowslide
