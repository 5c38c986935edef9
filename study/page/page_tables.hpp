#pragma once
#include "study/page/page.hpp"

#include <string>
#include <vector>

namespace flowslide::study {

/// Relations of a result, the strongest first.
std::vector<const Relation*> strongest(const StudyFindings& findings, const std::string& result);

/// The strongest relations of the first result as sentences, all others folded.
std::string relations_list(const Table& table, const StudyFindings& findings);

bool any_report(const StudyAbout& about);

/// Inputs, results and runs of all rows, without the columns that say the same in each.
std::string rows_table(const Plan& plan, const Table& table, const StudyFindings& findings,
                       const StudyAbout& about);

/// The interpolated depth of liquefaction in place of that of nodes, which comes in steps of the
/// mesh, where every row that has the one has the other; else the column itself.
std::string finer(const Table& table, const std::string& column);

}  // namespace flowslide::study
