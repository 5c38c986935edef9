#pragma once
#include "config/yaml.hpp"
#include "study/plan/study_file.hpp"

/// Keys of a study file, one function each. All throw InputError with the place.
namespace flowslide::study {

/// Adds to `set` and to the places of its entries in a part.
void read_set(const YamlNode& node, Part& part);
std::vector<Variable> read_vary(const YamlNode& node);
/// `table` with `columns`: a choice per line of a CSV file.
void read_table(Variable& variable, const YamlNode& node);
Sample read_sample(const YamlNode& node);
Repeat read_repeat(const YamlNode& node);
SlurmSettings read_slurm(const YamlNode& node);

/// The place as it stands in messages.
std::string place_of(const YamlNode& node);

}  // namespace flowslide::study
