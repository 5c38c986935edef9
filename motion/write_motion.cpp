#include "motion/write_motion.hpp"

#include <fstream>
#include <system_error>

namespace flowslide {

std::string motion_csv(const GroundMotion& motion) {
  check(motion);
  std::string origin = motion.origin;
  for (char& c : origin)
    if (c == '\n' || c == '\r') c = ' ';
  std::string text = fmt::format("# {}\ntime_s,acceleration_m_s2\n", origin);
  for (std::size_t i = 0; i < motion.acceleration.size(); ++i)
    text += fmt::format("{},{}\n", static_cast<double>(i) * motion.dt, motion.acceleration[i]);
  return text;
}

void write_motion(const std::filesystem::path& path, const GroundMotion& motion) {
  const std::string text = motion_csv(motion);
  const std::filesystem::path partial = path.string() + ".partial";
  std::ofstream out(partial, std::ios::binary);
  out << text;
  out.close();
  std::error_code error;
  if (out) std::filesystem::rename(partial, path, error);
  if (!out || error)
    throw FileError(
        fmt::format("{}: cannot be written (no such folder, no permission, or the "
                    "disk is full?)",
                    path.string()));
}

}  // namespace flowslide
