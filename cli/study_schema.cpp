#include "cli/study_schema.hpp"

#include "study/numbers/design.hpp"
#include "study/plan/study_file.hpp"

#include <nlohmann/json.hpp>

namespace flowslide::cli {
namespace {

using Json = nlohmann::ordered_json;

const Json kAny = true;
constexpr const char* kName = "^[A-Za-z0-9][A-Za-z0-9_-]*$";
constexpr const char* kPath = "^stages\\.[^=]+$";

Json text(const char* doc) { return {{"type", "string"}, {"description", doc}}; }

/// A number, or one with its unit.
Json amount(const char* doc) {
  return {{"type", Json::array({"number", "string"})}, {"description", doc}};
}

Json count(int least, const char* doc) {
  return {{"type", "integer"}, {"minimum", least}, {"description", doc}};
}

Json one_of(Json values, const char* doc) {
  return {{"enum", std::move(values)}, {"description", doc}};
}

Json map(Json properties, Json required = Json::array()) {
  return {{"type", "object"},
          {"additionalProperties", false},
          {"required", std::move(required)},
          {"properties", std::move(properties)}};
}

/// Entries whose names the user chooses.
Json entries(const char* pattern, const Json& value) {
  return {{"type", "object"},
          {"additionalProperties", false},
          {"patternProperties", {{pattern, value}}}};
}

Json list_of(const Json& item) { return {{"type", "array"}, {"minItems", 1}, {"items", item}}; }

Json one_or_list(const Json& item) { return {{"anyOf", Json::array({item, list_of(item)})}}; }

Json setting() {
  return one_or_list({{"type", "string"}, {"pattern", kPath}, {"description", "as in --set"}});
}

Json variable() {
  const Json labels = list_of(kAny);
  const Json range = map({{"from", amount("first value")},
                          {"to", amount("last value")},
                          {"step", amount("distance of two values")},
                          {"count", count(2, "how many values")},
                          {"spacing", one_of({"linear", "log"}, "equal steps or equal ratios")}},
                         {"from", "to"});
  return {
      {"anyOf",
       {map({{"setting", setting()}, {"values", list_of(kAny)}, {"labels", labels}},
            {"setting", "values"}),
        map({{"setting", setting()}, {"range", range}, {"labels", labels}}, {"setting", "range"}),
        map({{"zip", entries(kPath, list_of(kAny))}, {"labels", labels}}, {"zip"}),
        map({{"table", text("FILE.csv, relative to this file")},
             {"columns", {{"type", "object"}, {"additionalProperties", setting()}}},
             {"rows", list_of(kAny)}},
            {"table", "columns"})}}};
}

Json sample() {
  const Json normal = map({{"mean", amount("of the number itself")},
                           {"deviation", amount("of the number itself")},
                           {"min", amount("cut off below")},
                           {"max", amount("cut off above")}},
                          {"mean", "deviation"});
  const Json input =
      map({{"setting", setting()},
           {"uniform", map({{"from", amount("least")}, {"to", amount("most")}}, {"from", "to"})},
           {"triangular",
            map({{"from", amount("least")}, {"mode", amount("likeliest")}, {"to", amount("most")}},
                {"from", "mode", "to"})},
           {"normal", normal},
           {"lognormal", normal}},
          {"setting"});
  return map({{"method", one_of(study::kSamplings, "how points are spread")},
              {"count", count(1, "rows per combination of vary")},
              {"seed", count(0, "other points for another one")},
              {"inputs", entries(kName, input)},
              {"correlations", list_of(list_of(kAny))}},
             {"count", "inputs"});
}

Json repeat() {
  const Json number = {{"type", "number"}};
  return {{"anyOf",
           {count(1, "realisations; the first is undisturbed"),
            map({{"count", count(1, "realisations; the first is undisturbed")},
                 {"motion", number},
                 {"grid", {{"type", "boolean"}}},
                 {"scale", entries(kPath, number)},
                 {"rows", entries(kName, one_or_list(kAny))}},
                {"count"})}}};
}

Json slurm() {
  const Json name = {{"type", "string"}, {"pattern", "^[A-Za-z0-9_.,+@:][A-Za-z0-9_.,+@:-]*$"}};
  return map({{"partition", name},
              {"account", name},
              {"cpus", count(1, "of a task: as many stages side by side")},
              {"memory", text("4 GB (MB, GB, TB), of a task")},
              {"time", text("4 h, limit of a task")},
              {"chunk", text("30 min, that a task is expected to take at least")},
              {"options", list_of({{"type", "string"},
                                   {"pattern", "^-"},
                                   {"description", "of sbatch, as in --qos=low"}})}});
}

Json part(Json more) {
  more["set"] = entries(kPath, kAny);
  more["vary"] = entries(kName, variable());
  more["sample"] = sample();
  more["repeat"] = repeat();
  return more;
}

}  // namespace

std::string study_schema() {
  const Json file = text("workflow, relative to this file");
  Json body = part({{"workflow", {{"anyOf", {file, entries(kName, file)}}}}});
  body["also"] = entries(kName, map(part({{"workflow", file}})));
  body["keep"] = one_of(study::kKeeps, "what stays on the disk of each stage");
  body["disk"] = text("2 GB (MB, GB, TB)");
  body["limits"] = map({{"stage_time", text("2 h, of one stage")}});
  body["slurm"] = slurm();
  body["analysis"] = map({{"results", one_or_list(text("column of the table"))},
                          {"thresholds", list_of(list_of(text("column of the table")))},
                          {"seed", count(0, "of the resampling")}});
  const Json schema = {{"$schema", "https://json-schema.org/draft/2020-12/schema"},
                       {"title", "flowslide study"},
                       {"type", "object"},
                       {"required", {"schema", "name", "study"}},
                       {"additionalProperties", false},
                       {"properties",
                        {{"schema", {{"const", 1}}},
                         {"name", {{"type", "string"}, {"pattern", kName}}},
                         {"description", text("stands above the report")},
                         {"study", map(body, {"workflow"})}}}};
  return schema.dump(2);
}

}  // namespace flowslide::cli
