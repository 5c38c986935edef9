#include "bench/mpm/cases.hpp"

#include "bench/mpm/speed.hpp"

namespace flowslide {

std::vector<BenchCase> mpm_benchmarks() {
  return {
      {"mpm/2d/linear", "whole steps in plane strain, hat functions", mpm::measure_linear<2>},
      {"mpm/2d/quadratic", "whole steps in plane strain, quadratic splines",
       mpm::measure_quadratic<2>},
      {"mpm/3d/linear", "whole steps in three dimensions, hat functions", mpm::measure_linear<3>},
      {"mpm/3d/quadratic", "whole steps in three dimensions, quadratic splines",
       mpm::measure_quadratic<3>},
      {"mpm/3d/valley", "the dam as a valley of 73 m, two million points", mpm::measure_valley},
      {"mpm/large", "ten million points in the plane and two in space: speed and memory",
       mpm::measure_large, true},
      {"mpm/curve", "error against processor time of bases and transfers", mpm::work_precision},
      {"mpm/front", "error of a dry column's front against processor time", mpm::front_precision},
  };
}

}  // namespace flowslide
