#pragma once
#include "core/conventions.hpp"
#include "model/ground_motion.hpp"

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <zlib.h>

namespace flowslide::test {

/// f(t) at 0, dt, ... up to and with `end`.
inline GroundMotion sampled(double dt, double end, const std::function<double(double)>& f) {
  GroundMotion motion{.dt = dt, .acceleration = {}, .origin = "signal"};
  const int n = static_cast<int>(std::lround(end / dt));
  for (int i = 0; i <= n; ++i) motion.acceleration.push_back(f(i * dt));
  return motion;
}

inline GroundMotion harmonic(double amplitude, double frequency, double dt, double end) {
  return sampled(dt, end,
                 [=](double t) { return amplitude * std::sin(2.0 * kPi * frequency * t); });
}

/// A folder of its own that disappears with the test.
class MotionFolder {
 public:
  MotionFolder() {
    std::string pattern = (std::filesystem::temp_directory_path() / "flowslide-XXXXXX").string();
    if (!mkdtemp(pattern.data())) throw std::runtime_error("no temporary folder");
    path_ = pattern;
  }
  ~MotionFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  MotionFolder(const MotionFolder&) = delete;
  MotionFolder& operator=(const MotionFolder&) = delete;

  [[nodiscard]] std::filesystem::path path(std::string_view name) const { return path_ / name; }
  std::filesystem::path write(std::string_view name, std::string_view text) const {
    std::ofstream(path(name), std::ios::binary) << text;
    return path(name);
  }
  std::filesystem::path write_gzip(std::string_view name, std::string_view text) const {
    const gzFile file = gzopen(path(name).c_str(), "wb9");
    gzwrite(file, text.data(), static_cast<unsigned>(text.size()));
    gzclose(file);
    return path(name);
  }

 private:
  std::filesystem::path path_;
};

}  // namespace flowslide::test
