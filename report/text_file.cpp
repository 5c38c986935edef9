#include "report/text_file.hpp"

#include "core/check.hpp"

#include <fstream>
#include <string>
#include <system_error>

namespace flowslide {

void write_file(const std::filesystem::path& path, std::string_view bytes) {
  const std::filesystem::path partial = path.string() + ".partial";
  std::ofstream file(partial, std::ios::binary | std::ios::trunc);
  file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  file.close();
  std::error_code error;
  if (file) std::filesystem::rename(partial, path, error);
  if (!file || error)
    throw FileError(fmt::format(
        "{}: cannot be written (the report would be incomplete) check the free space and the "
        "rights of the folder",
        path.string()));
}

}  // namespace flowslide
