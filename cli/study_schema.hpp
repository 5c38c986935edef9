#pragma once
#include <nlohmann/json.hpp>

namespace flowslide::cli {

/// JSON Schema of study files, for editors. docs/guide/studies.md
nlohmann::ordered_json study_schema();

}  // namespace flowslide::cli
