#pragma once
#include "study/statistics/bootstrap.hpp"
#include "study/table/table.hpp"

#include <string>

/// How numbers and columns read on the page of a study.
namespace flowslide::study {

std::string short_number(double v);
/// "12.5 (10 to 15)".
std::string interval(const Estimate& e);
/// "runout [m]" of the column runout_m.
std::string readable(const Table& table, const std::string& name);

}  // namespace flowslide::study
