#include "workflows/engine/program_version.hpp"

#include "program_version_values.hpp"

namespace flowslide {

std::string program_version() {
  const std::string revision = FLOWSLIDE_REVISION;
  const std::string version = "flowslide " FLOWSLIDE_VERSION;
  return revision.empty() ? version : version + " (" + revision + ")";
}

}  // namespace flowslide
