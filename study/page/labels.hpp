#pragma once
#include "study/statistics/bootstrap.hpp"
#include "study/table/table.hpp"

#include <string>
#include <vector>

/// How numbers and columns read on the page of a study.
namespace flowslide::study {

std::string short_number(double v);
/// "12.5 (10 to 15)".
std::string interval(const Estimate& e);
/// "runout [m]" of the column runout_m.
std::string readable(const Table& table, const std::string& name);
/// "row 12: pga 0.3 g, c_soft 0.5".
std::string row_title(const Row& row);
/// "1 to 3, 7" of rows counted from 0; of many pieces the first dozen.
std::string spans_of(const std::vector<std::size_t>& rows);

}  // namespace flowslide::study
