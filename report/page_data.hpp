#pragma once
#include "report/page_arrays.hpp"
#include "report/report.hpp"

#include <string>

namespace flowslide {

/// What the scripts of the page draw from: arrays, and a JSON object of single numbers, names and
/// lines. page/page.js reads both.
struct PageData {
  PageArrays arrays;
  std::string json;
};

/// `end` belongs to `in.flow`. Throws as PageArrays::add, FileError, InputError.
PageData page_data(const ReportInputs& in, const ReportConfig& config, const ReportFacts& facts,
                   const FinalState& end);

}  // namespace flowslide
