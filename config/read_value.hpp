#pragma once
#include "config/yaml.hpp"

#include <span>
#include <string>
#include <string_view>
#include <vector>

/// One value of a YAML document. All throw InputError with location and path.
namespace flowslide {

double read_quantity(const YamlNode& node, Dim dim, const Range& range);
int read_integer(const YamlNode& node, const Range& range);
bool read_flag(const YamlNode& node);
std::string read_text(const YamlNode& node);
InputFile read_file(const YamlNode& node);
/// Index of the value in `names`.
int read_choice(const YamlNode& node, std::span<const std::string_view> names);
std::vector<double> read_row(const YamlNode& row, std::span<const FieldVisitor::Column> columns);
void expect_list(const YamlNode& node);

}  // namespace flowslide
