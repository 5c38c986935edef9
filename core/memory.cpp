#include "core/memory.hpp"

#include "core/check.hpp"

#include <algorithm>
#include <fstream>
#include <limits>
#include <string>

namespace flowslide {
namespace {

/// The first number of a file of the system; NaN if there is none, as for "max".
double number_in(const char* path) {
  std::ifstream file(path);
  double value = kUnset;
  return file >> value ? value : kUnset;
}

double of_machine(std::string_view which) {
  std::ifstream file("/proc/meminfo");
  std::string name;
  for (double value = 0.0; file >> name >> value; file.ignore(80, '\n'))
    if (name == which) return value * 1024.0;
  return std::numeric_limits<double>::infinity();
}

}  // namespace

double available_memory() {
  const double group =
      number_in("/sys/fs/cgroup/memory.max") - number_in("/sys/fs/cgroup/memory.current");
  const double machine = of_machine("MemAvailable:");
  return is_set(group) ? std::min(group, machine) : machine;
}

double machine_memory() {
  const double group = number_in("/sys/fs/cgroup/memory.max"), machine = of_machine("MemTotal:");
  return is_set(group) ? std::min(group, machine) : machine;
}

void need_memory(double bytes, std::string_view what, std::string_view advice) {
  constexpr double kShare = 0.9;
  const double available = available_memory();
  validate(bytes <= kShare * available,
           "{} would need about {:.3g} GB of memory (this machine has {:.3g} GB to give) {}", what,
           bytes * 1e-9, available * 1e-9, advice);
}

}  // namespace flowslide
