#pragma once
#include <string>

namespace flowslide::cli {

/// JSON Schema of study files, for editors. docs/guide/studies.md
std::string study_schema();

}  // namespace flowslide::cli
