#pragma once
#include "tests/support/scratch.hpp"

using flowslide::Scratch;

inline std::string bytes_of(const std::filesystem::path& path) {
  return flowslide::read_text_file(path);
}

inline void put_bytes(const std::filesystem::path& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary) << bytes;
}
