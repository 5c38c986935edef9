#pragma once
#include <string>

namespace flowslide {

/// "flowslide 0.1.0 (4f2c1aa)": version of the project and, if built from a git checkout, its
/// revision with "-dirty" if files were changed.
std::string program_version();

}  // namespace flowslide
