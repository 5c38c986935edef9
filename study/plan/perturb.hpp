#pragma once
#include "config/yaml.hpp"
#include "study/plan/study_file.hpp"

namespace flowslide::study {

/// Factor less 1 of realisation 0, 1, 2, 3, 4, ...: 0, step, -step, 2 step, -2 step, ...
double change_of(std::size_t realisation, double step);

/// Share of a cell by which realisation k moves the grid along x and y: the sequence of Roberts
/// (2018), which fills a square evenly from its first points on; (0, 0) for the first.
std::array<double, 2> shift_of(std::size_t realisation);

/// What a realisation sets in a workflow, whose settings are those of the row already. Nothing for
/// the first. InputError if there is nothing to disturb.
Settings perturbations(const YamlNode& workflow, const Repeat& repeat, std::size_t realisation);

}  // namespace flowslide::study
