#include "study/table/analysis.hpp"

#include <nlohmann/json.hpp>

namespace flowslide::study {
namespace {

using Json = nlohmann::ordered_json;

Json json_of(const Estimate& e) {
  return {{"value", e.value}, {"low", e.low}, {"high", e.high}, {"rows", e.rows}};
}

Json json_of(const Relation& r) {
  return {{"x", r.x},
          {"y", r.y},
          {"spearman", json_of(r.spearman)},
          {"spearman_within", json_of(r.within)},
          {"within", r.by},
          {"line",
           {{"intercept", json_of(r.line.intercept)},
            {"slope", json_of(r.line.slope)},
            {"r2", r.line.r2}}}};
}

Json json_of(const Threshold& t) {
  return {{"x", t.x},
          {"y", t.y},
          {"where", t.where},
          {"breach", json_of(t.ramp.breach)},
          {"breach_seen", t.ramp.begins()},
          {"saturation", json_of(t.ramp.saturation)},
          {"saturation_seen", t.ramp.ends()},
          {"plateau", json_of(t.ramp.plateau)},
          {"r2", t.ramp.r2},
          {"r2_of_a_line", t.ramp.line_r2}};
}

}  // namespace

std::string to_json_text(const Plan& plan, const StudyFindings& f,
                         const std::map<std::string, std::string>& figures) {
  Json results = Json::array(), relations = Json::array(), swings = Json::array(),
       thresholds = Json::array(), comparisons = Json::array();
  for (std::size_t i = 0; i < f.results.size(); ++i)
    results.push_back({{"name", f.results[i]},
                       {"numerical_scatter", f.scatter[i].numerical},
                       {"repeated_groups", f.scatter[i].repeated},
                       {"spread_of_inputs", f.scatter[i].of_inputs},
                       {"exceedance",
                        {{"value", f.exceedance[i].value},
                         {"share", f.exceedance[i].share},
                         {"band", f.exceedance[i].band}}}});
  for (const Relation& r : f.relations) relations.push_back(json_of(r));
  for (const Swing& s : f.swings)
    swings.push_back({{"input", s.input},
                      {"result", s.result},
                      {"from", s.effect.low_label},
                      {"to", s.effect.high_label},
                      {"low", s.effect.low},
                      {"high", s.effect.high},
                      {"swing", json_of(s.effect.swing)}});
  for (const Threshold& t : f.thresholds) thresholds.push_back(json_of(t));
  for (const Comparison& c : f.comparisons)
    comparisons.push_back({{"result", c.result},
                           {"over", f.variant},
                           {"under", c.variant},
                           {"where", c.where},
                           {"ratio", json_of(c.ratio)}});
  Json not_compared = Json::array();
  for (const NotCompared& n : f.not_compared)
    not_compared.push_back({{"result", n.result}, {"under", n.variant}, {"why", n.why}});
  return Json({{"schema", 1},
               {"study", plan.name},
               {"variant", f.variant},
               {"groups", f.groups.size()},
               {"results", results},
               {"relations", relations},
               {"tornado", swings},
               {"thresholds", thresholds},
               {"comparisons", comparisons},
               {"not_compared", not_compared},
               {"figures", figures}})
             .dump(2, ' ', false, Json::error_handler_t::replace) +
         "\n";
}

}  // namespace flowslide::study
