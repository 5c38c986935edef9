#pragma once
#include "study/page/page.hpp"

#include <string>

namespace flowslide::study {

/// What the chart starts with; names of columns, `colour` may be empty.
struct ExplorerStart {
  std::string x, y, colour;
};

/// JSON of all rows for the scripts of the page: {labels, pages, embedded:
/// are they in this file, groups: which repeats belong
/// together, columns: [{name, label, unit, group, ...}], start}. A column has its `values`, null
/// where there is none, or the one that is the `same` in all rows; a column of words has them in
/// `words` and their places as values. Numbers have six digits.
std::string explorer_json(const Plan& plan, const Table& table, const StudyFindings& findings,
                          const StudyAbout& about, const ExplorerStart& start);

}  // namespace flowslide::study
