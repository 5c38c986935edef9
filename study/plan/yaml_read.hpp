#pragma once
#include "config/yaml.hpp"
#include "study/plan/amount.hpp"

#include <string>
#include <string_view>
#include <vector>

/// Parts of a study file. All throw InputError with the place.
namespace flowslide::study {

void allow_keys(const YamlNode& map, const std::vector<std::string>& known);
YamlNode need(const YamlNode& map, std::string_view key, std::string_view why);
Amount read_amount(const YamlNode& node);
/// A number without a unit.
double read_number(const YamlNode& node);
std::size_t read_count(const YamlNode& node, std::size_t least, std::size_t most);
/// "2 GB" [bytes], "30 min" [s]; above 0.
double read_bytes(const YamlNode& node);
double read_time(const YamlNode& node);
/// A list of texts, or one text.
std::vector<std::string> read_texts(const YamlNode& node);
/// "stages." and what follows.
bool is_path(std::string_view setting);
void expect_path(const YamlNode& place, const std::string& path);
/// Paths of settings: "stages.map.with.cell", or a list of them.
std::vector<std::string> read_settings_paths(const YamlNode& node);
/// Whatever the value is, as text that YAML reads back as the same.
std::string flow_text(const YamlNode& node);

}  // namespace flowslide::study
