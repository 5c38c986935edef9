#include "motion/write_motion.hpp"

#include "core/files.hpp"

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
  write_file(path, motion_csv(motion));
}

}  // namespace flowslide
