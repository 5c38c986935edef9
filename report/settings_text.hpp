#pragma once
#include <string>
#include <string_view>
#include <utility>
#include <vector>

/// Settings of the stages before the report, as canonical text tells them: one "path = value" a
/// line, every setting with its unit, those left out with their default.
namespace flowslide {

/// A stage whose result the report builds on.
struct ToldStage {
  std::string name;      ///< in the workflow
  std::string uses;      ///< "mpm.run"
  std::string settings;  ///< canonical text
  std::string facts;     ///< JSON object
};

struct Setting {
  std::string path;
  std::string value;
};
std::vector<Setting> read_settings_text(std::string_view text);

/// The first stage of a type, null if there is none.
const ToldStage* find_stage(const std::vector<ToldStage>& stages, std::string_view uses);

/// Value of one setting, empty if it is not there.
std::string find_setting(std::string_view settings, std::string_view path);

/// Numbers of "[[0 m, -2 m], [36 m, 0 m]]", row by row and without their units; empty for anything
/// else.
std::vector<std::vector<double>> rows_of(std::string_view value);

/// What stands below `prefix."NAME".`: a row for each setting, a column for each name.
struct SettingsTable {
  std::vector<std::string> names;
  std::vector<std::pair<std::string, std::vector<std::string>>> rows;
};
SettingsTable settings_table(const std::vector<Setting>& settings, std::string_view prefix);

/// A number in JSON below a key, unset if there is none.
double number_in(std::string_view json, const std::string& key);

}  // namespace flowslide
