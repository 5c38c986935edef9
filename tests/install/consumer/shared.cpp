#include "motion/measures.hpp"
#include "motion/synthetic.hpp"

/// For a library that Python or another program loads: the modules are position-independent.
extern "C" double peak_of_motion(double pga, double tm, double d5_95) {
  return flowslide::pga(flowslide::synthesize({.pga = pga, .tm = tm, .d5_95 = d5_95}));
}
