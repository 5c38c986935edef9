#include "model/motion_file.hpp"
#include "motion/measures.hpp"
#include "motion/prepare.hpp"
#include "tests/fuzz/input.hpp"
#include "tests/fuzz/targets.hpp"

namespace flowslide::fuzz {

void motion(Input input) {
  Parts parts(input);
  Switches choose(parts.section());
  MotionConfig config;
  RecordFormat& format = config.format;
  if (choose.flag()) format.unit = std::array{"g", "cm/s2", "m/s2"}[choose.choose(3)];
  if (choose.flag()) format.dt = 0.01;
  format.time_column = static_cast<int>(choose.choose(4));
  format.acceleration_column = static_cast<int>(choose.choose(4));
  format.accept_count = choose.flag();
  if (choose.flag()) config.baseline.emplace();
  if (choose.flag()) config.pga = 3.0;
  config.record = InputFile{file("record.AT2", parts.rest())};
  accepts([&] {
    const GroundMotion prepared = prepare_motion(config);
    write_motion_file(folder() / "motion.h5", prepared);
    (void)measure(prepared);
  });
}

}  // namespace flowslide::fuzz
