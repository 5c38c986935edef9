#include "report/npy.hpp"

#include "core/check.hpp"
#include "core/files.hpp"

#include <bit>
#include <string>

namespace flowslide {

void write_npy(const std::filesystem::path& path, const Table& table) {
  static_assert(std::endian::native == std::endian::little, "the header below says '<f8'");
  FLOWSLIDE_EXPECT(table.columns > 0 && table.values.size() % table.columns == 0);
  std::string header =
      fmt::format("{{'descr': '<f8', 'fortran_order': False, 'shape': ({}, {}), }}", table.rows(),
                  table.columns);
  constexpr std::size_t prefix = 10;  // magic, version and length of the header
  header.append(63 - (prefix + header.size()) % 64, ' ');
  header += '\n';
  std::string bytes("\x93NUMPY\x01\x00", 8);
  bytes += static_cast<char>(header.size() & 0xff);
  bytes += static_cast<char>(header.size() >> 8);
  bytes += header;
  bytes.append(reinterpret_cast<const char*>(table.values.data()),
               table.values.size() * sizeof(double));
  write_file(path, bytes);
}

}  // namespace flowslide
