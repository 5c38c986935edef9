#include "cli/short_waits.hpp"

#include <cstdlib>
#include <unistd.h>

namespace flowslide::cli {

void prefer_short_waits(char** argv) {
  if (std::getenv("GOMP_SPINCOUNT") || std::getenv("OMP_WAIT_POLICY")) return;
  if (::setenv("GOMP_SPINCOUNT", "1000", 0) != 0) return;
  ::execv("/proc/self/exe", argv);  // returns only if that failed, and then nothing is lost
}

}  // namespace flowslide::cli
