#include "exchange/is_terrain.hpp"

#include "mpm/walls/is_height_field.hpp"

#include <fstream>
#include <iterator>
#include <string>

namespace flowslide {

bool is_terrain(const std::filesystem::path& path) {
  std::ifstream in(path);
  std::string head(256, '\0');
  in.read(head.data(), std::ssize(head));
  head.resize(static_cast<std::size_t>(in.gcount()));
  return mpm::is_height_field(head);
}

}  // namespace flowslide
