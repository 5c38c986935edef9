#pragma once
#include "mpm/kernels/scheme.hpp"

#include <string_view>

namespace flowslide::mpm {

/// A transfer of velocity and what its rows are called.
struct NamedTransfer {
  std::string_view name;
  Transfer transfer;
};

}  // namespace flowslide::mpm
