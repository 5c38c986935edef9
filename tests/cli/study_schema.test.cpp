#include "tests/cli/program.hpp"

#include <regex>

#include <nlohmann/json.hpp>

using namespace flowslide;
using namespace flowslide::cli::test;
using nlohmann::json;

namespace {

bool has_type(const json& value, const json& type) {
  if (type.is_array())
    return std::any_of(type.begin(), type.end(),
                       [&](const json& one) { return has_type(value, one); });
  return (type == "object" && value.is_object()) || (type == "array" && value.is_array()) ||
         (type == "string" && value.is_string()) || (type == "boolean" && value.is_boolean()) ||
         (type == "number" && value.is_number()) ||
         (type == "integer" && value.is_number_integer());
}

/// As much of JSON Schema as the schema of studies uses; another word would be refused here.
bool fits(const json& value, const json& schema) {
  if (schema.is_boolean()) return schema.get<bool>();
  for (const auto& [word, rule] : schema.items()) {
    bool good = true;
    if (word == "type") {
      good = has_type(value, rule);
    } else if (word == "const") {
      good = value == rule;
    } else if (word == "enum") {
      good = std::find(rule.begin(), rule.end(), value) != rule.end();
    } else if (word == "pattern") {
      good = value.is_string() &&
             std::regex_search(value.get<std::string>(), std::regex(rule.get<std::string>()));
    } else if (word == "minimum") {
      good = value.is_number() && value >= rule;
    } else if (word == "minItems") {
      good = value.size() >= rule.get<std::size_t>();
    } else if (word == "items") {
      for (const json& item : value) good &= fits(item, rule);
    } else if (word == "anyOf") {
      good =
          std::any_of(rule.begin(), rule.end(), [&](const json& one) { return fits(value, one); });
    } else if (word == "required") {
      for (const json& key : rule) good &= value.is_object() && value.contains(key);
    } else if (word == "additionalProperties" && value.is_object()) {
      for (const auto& [key, entry] : value.items()) {
        const std::string name = key;
        const json patterns = schema.value("patternProperties", json::object());
        bool known = schema.contains("properties") && schema["properties"].contains(name);
        for (const auto& [pattern, unused] : patterns.items())
          known |= std::regex_search(name, std::regex(pattern));
        good &= known || fits(entry, rule);
      }
    } else if (word == "properties" && value.is_object()) {
      for (const auto& [key, inner] : rule.items())
        if (value.contains(key)) good &= fits(value[key], inner);
    } else if (word == "patternProperties" && value.is_object()) {
      for (const auto& [pattern, inner] : rule.items())
        for (const auto& [key, entry] : value.items())
          if (std::regex_search(key, std::regex(pattern))) good &= fits(entry, inner);
    } else if (word != "description" && word != "title" && word != "$schema" &&
               word != "properties" && word != "patternProperties" &&
               word != "additionalProperties") {
      throw std::runtime_error("unknown word " + word);
    }
    if (!good) return false;
  }
  return true;
}

json study(const std::string& body) {
  return json::parse(R"({"schema": 1, "name": "s", "study": {"workflow": "w.yaml")" +
                     (body.empty() ? "" : ", " + body) + "}}");
}

const std::vector<std::string> kGood{
    R"("set": {"stages.shake.with.sigma_zz": {"rule": "mean"}})",
    R"("vary": {"f": {"setting": "stages.shake.with.a", "values": [1, "2 m", {"rule": "mean"}]}})",
    R"("vary": {"f": {"setting": ["stages.a.with.b", "stages.c.with.d"], "values": [1], "labels": ["x"]}})",
    R"("vary": {"f": {"setting": "stages.a.with.b", "range": {"from": "1 m", "to": "2 m", "step": "1 m"}}})",
    R"("vary": {"f": {"zip": {"stages.a.with.b": [1, 2]}, "labels": ["x", "y"]}})",
    R"("vary": {"f": {"table": "t.csv", "columns": {"a": "stages.a.with.b"}, "rows": ["x"]}})",
    R"("sample": {"count": 2, "method": "sobol", "seed": 0, "inputs": {"f": {"setting": "stages.a.with.b",
       "normal": {"mean": "5 kPa", "deviation": "1 kPa", "min": "0 kPa"}}}, "correlations": [["f", "g", 0.5]]})",
    R"("repeat": 3)",
    R"("repeat": {"count": 3, "motion": 1e-6, "grid": true, "scale": {"stages.a.with.b": 1e-6}, "rows": {"f": [1]}})",
    R"("also": {"static": {"workflow": "v.yaml", "vary": {}, "repeat": 2}}, "keep": "numbers", "disk": "2 GB")",
    R"("slurm": {"partition": "day,night", "account": "geo", "cpus": 4, "memory": "4 GB", "time": "4 h",
       "chunk": "30 min", "options": ["--qos=low"]})",
    R"("limits": {"stage_time": "2 h"}, "analysis": {"results": ["a"], "thresholds": [["a", "b"]], "seed": 1})"};

const std::vector<std::string> kBad{
    R"("vry": {})",
    R"("vary": {"f": {"setting": "shake.with.a", "values": [1]}})",
    R"("vary": {"f": {"setting": "stages.a.with.b"}})",
    R"("vary": {"f": {"setting": "stages.a.with.b", "values": []}})",
    R"("vary": {"a b": {"setting": "stages.a.with.b", "values": [1]}})",
    R"("sample": {"count": 0, "inputs": {}})",
    R"("sample": {"count": 2, "method": "magic", "inputs": {}})",
    R"("repeat": "often")",
    R"("repeat": {"grid": true})",
    R"("keep": "everything")",
    R"("slurm": {"queue": "day"})",
    R"("slurm": {"partition": "day\n#SBATCH --wrap=x"})",
    R"("slurm": {"cpus": 0})",
    R"("slurm": {"options": "--qos=low"})",
    R"("slurm": {"options": ["qos=low"]})",
    R"("analysis": {"results": {}})"};

}  // namespace

TEST_CASE("the schema of studies takes what the program takes, and refuses what it refuses",
          "[cli]") {
  const Scratch scratch;
  write_model(scratch);
  scratch.write("w.yaml", "schema: 1\nname: w\nstages:\n" + shake());
  scratch.write("v.yaml", "schema: 1\nname: v\nstages:\n" + shake());
  scratch.write("t.csv", "case, a\nx, 1\n");
  const Outcome o = call(scratch, "schema --study");
  REQUIRE(o.code == 0);
  const json schema = json::parse(o.out);
  CHECK(fits(study(""), schema));
  for (const std::string& body : kGood) {
    CAPTURE(body);
    CHECK(fits(study(body), schema));
  }
  for (const std::string& body : kBad) {
    CAPTURE(body);
    CHECK_FALSE(fits(study(body), schema));
    // JSON is YAML.
    scratch.write("s.yaml", study(body).dump());
    CHECK(call(scratch, "study run s.yaml --dry-run").code == 2);
  }
}
