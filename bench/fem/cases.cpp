#include "bench/fem/cases.hpp"

#include "bench/fem/speed.hpp"

namespace flowslide {

std::vector<BenchCase> fem_benchmarks() {
  return {
      {"fem/pm4sand", "sub-steps of PM4Sand, and stress error, against its tolerances",
       fem::measure_pm4sand},
      {"fem/step", "element updates of the explicit step", fem::measure_step},
  };
}

}  // namespace flowslide
