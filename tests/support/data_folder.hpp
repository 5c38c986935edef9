#pragma once
#include "tests/support/scratch.hpp"

#include <string_view>
#include <zlib.h>

namespace flowslide::test {

/// A scratch folder for files as users have them, compressed ones among them.
class DataFolder : public Scratch {
 public:
  [[nodiscard]] std::filesystem::path path(std::string_view name) const {
    return Scratch::path() / name;
  }
  std::filesystem::path write(std::string_view name, std::string_view content) const {
    return Scratch::write(std::string(name), std::string(content));
  }
  std::filesystem::path write_gzip(std::string_view name, std::string_view content) const {
    const gzFile file = gzopen(path(name).c_str(), "wb9");
    gzwrite(file, content.data(), static_cast<unsigned>(content.size()));
    gzclose(file);
    return path(name);
  }
};

}  // namespace flowslide::test
