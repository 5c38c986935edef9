#pragma once
#include "study/table/analysis.hpp"

#include <string>

namespace flowslide::study {

/// What a study says, in sentences and as HTML, for whoever has to judge it and knows neither the
/// program nor the study file: how far, how sure, why, and what would change it. Of its first
/// result.
std::string judgement(const Plan& plan, const Table& table, const StudyFindings& f);

/// The same result in a few large numbers.
std::string cards(const Plan& plan, const Table& table, const StudyFindings& f);

/// What stages warned of, each once with the rows that it holds for.
std::string warnings(const Table& table);

/// How much a number goes with another: within levels where it has such, -1 where not known.
double strength(const Relation& r);

/// Where runout begins and where it stops to grow.
std::string threshold_sentence(const Table& table, const Threshold& t);

}  // namespace flowslide::study
