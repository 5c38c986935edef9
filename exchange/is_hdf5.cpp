#include "exchange/is_hdf5.hpp"

#include "core/check.hpp"
#include "core/unreadable.hpp"

#include <array>
#include <fstream>
#include <string_view>

namespace flowslide {

bool is_hdf5(const std::filesystem::path& path) {
  if (const std::string why = why_unreadable(path); !why.empty())
    throw FileError(fmt::format("{}: {}", path.string(), why));
  std::array<char, 8> head{};
  std::ifstream file(path, std::ios::binary);
  file.read(head.data(), head.size());
  if (!file.is_open() || file.bad())
    throw FileError(
        fmt::format("{}: cannot be read (the disk or the system refuses)", path.string()));
  constexpr std::string_view kHdf5 = "\x89HDF\r\n\x1a\n";
  return std::string_view(head.data(), head.size()) == kHdf5;
}

}  // namespace flowslide
