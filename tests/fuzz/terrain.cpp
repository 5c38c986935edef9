#include "mpm/walls/height_field.hpp"
#include "tests/fuzz/input.hpp"
#include "tests/fuzz/targets.hpp"

namespace flowslide::fuzz {

void terrain(Input input) {
  const auto path = file("valley.asc", input);
  accepts([&] {
    const mpm::HeightField field =
        mpm::read_height_field(path, {.origin = {100.0, 50.0}, .heading = 0.3, .level = 2.0});
    const std::array<double, 7> places{-1e12, -25.0, -1e-300, 0.0, 3.5, 40.0, 1e9};
    for (const double x : places)
      for (const double y : places) (void)field.at(x, y);
    mpm::check_covered(field, places, places, 1.0);
  });
}

}  // namespace flowslide::fuzz
