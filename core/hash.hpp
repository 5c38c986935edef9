#pragma once
#include <filesystem>
#include <string>
#include <string_view>

namespace flowslide {

/// SHA-256 as 64 lower-case hexadecimal digits.
std::string sha256(std::string_view bytes);

/// SHA-256 of a file's content, read in blocks. Throws FileError.
std::string sha256_file(const std::filesystem::path& path);

}  // namespace flowslide
