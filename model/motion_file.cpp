#include "model/motion_file.hpp"

#include "model/field_store.hpp"

namespace flowslide {
namespace {

constexpr std::string_view kMotion = "motion";
constexpr int kMotionFormat = 1;

}  // namespace

void write_motion_file(const std::filesystem::path& path, const GroundMotion& motion) {
  check(motion);
  FieldWriter out(path, kMotion, kMotionFormat);
  out.write("dt", std::vector<double>{motion.dt}, {.unit = "s"});
  out.write("acceleration", motion.acceleration,
            {.unit = "m/s2", .convention = "horizontal, to the right; sample i is at i dt"});
  out.write_texts("origin", {motion.origin});
  out.finish();
}

GroundMotion read_motion_file(const std::filesystem::path& path) {
  const FieldReader in(path, kMotion, kMotionFormat);
  GroundMotion motion;
  motion.dt = in.read_one<double>("dt");
  motion.acceleration = in.read<double>("acceleration");
  motion.origin = in.read_texts("origin", 1)[0];
  check(motion);
  return motion;
}

}  // namespace flowslide
