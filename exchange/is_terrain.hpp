#pragma once
#include <filesystem>

namespace flowslide {

/// Does a text begin as a grid of heights does?
bool is_terrain(const std::filesystem::path& path);

}  // namespace flowslide
