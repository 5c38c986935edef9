#include "study/plan/plan.hpp"
#include "study/plan/yaml_read.hpp"
#include "workflows/engine/names.hpp"

#include <algorithm>

namespace flowslide::study {
namespace {

constexpr int kSchema = 2;

Json settings_json(const Settings& settings) {
  Json list = Json::array();
  for (const auto& [path, value] : settings) list.push_back({path, value});
  return list;
}

Settings settings_from(const Json& json) {
  Settings settings;
  for (const Json& pair : json) settings.emplace_back(pair.at(0), pair.at(1));
  return settings;
}

/// Conversions of the library take any number for any type.
std::size_t index_from(const Json& json) { return static_cast<std::size_t>(whole_number(json)); }

std::vector<std::size_t> indices_from(const Json& json) {
  std::vector<std::size_t> indices;
  for (const Json& i : json) indices.push_back(index_from(i));
  return indices;
}

int small_from(const Json& json) {
  const std::uint64_t number = whole_number(json);
  validate(number < 1'000'000, "{} is too large", number);
  return static_cast<int>(number);
}

Json ports_json(const std::vector<Port>& ports) {
  Json list = Json::array();
  for (const Port& p : ports) list.push_back({p.name, p.kind, p.file});
  return list;
}

std::vector<Port> ports_from(const Json& json) {
  std::vector<Port> ports;
  for (const Json& p : json) ports.push_back({p.at(0), p.at(1), p.at(2)});
  return ports;
}

Json number_json(double x) { return is_set(x) ? Json(x) : Json(nullptr); }
double number_from(const Json& json) { return json.is_null() ? kUnset : json.get<double>(); }

Json node_json(const Node& node) {
  const WorkflowStage& stage = node.stage;
  Json links = Json::array();
  for (const Link& link : stage.inputs)
    links.push_back({link.port, link.from_stage, link.from_port});
  return {{"stage", stage.name},
          {"uses", stage.type.name},
          {"version", stage.type.version},
          {"checkpoints", stage.type.checkpoints},
          {"reads_warnings", stage.type.reads_warnings},
          {"reads_earlier", stage.type.reads_earlier},
          {"inputs", ports_json(stage.type.inputs)},
          {"outputs", ports_json(stage.type.outputs)},
          {"settings", stage.prepared.settings},
          {"links", links},
          {"warnings", stage.warnings},
          {"work",
           {number_json(stage.work.seconds), stage.work.parallel, number_json(stage.work.memory)}},
          {"before", node.before},
          {"recipe", node.recipe},
          {"row", node.row}};
}

Node node_from(const Json& json) {
  Node node;
  WorkflowStage& stage = node.stage;
  stage.name = json.at("stage");
  stage.type.name = json.at("uses");
  stage.type.version = small_from(json.at("version"));
  stage.type.checkpoints = json.at("checkpoints");
  stage.type.reads_warnings = json.at("reads_warnings");
  stage.type.reads_earlier = json.at("reads_earlier");
  stage.type.inputs = ports_from(json.at("inputs"));
  stage.type.outputs = ports_from(json.at("outputs"));
  stage.prepared.settings = json.at("settings");
  node.before = indices_from(json.at("before"));
  for (const Json& link : json.at("links")) {
    stage.inputs.push_back({link.at(0), index_from(link.at(1)), link.at(2)});
    validate(stage.inputs.back().from_stage < node.before.size(), "a link leads nowhere");
  }
  stage.warnings = json.at("warnings").get<std::vector<std::string>>();
  if (const auto work = json.find("work"); work != json.end())
    stage.work = {.seconds = number_from(work->at(0)),
                  .parallel = work->at(1),
                  .memory = number_from(work->at(2))};
  node.recipe = json.at("recipe");
  validate(is_name(stage.name), "'{}' is no name of a stage", stage.name);
  validate(is_digest(node.recipe), "'{}' is no digest", node.recipe);
  node.row = index_from(json.at("row"));
  return node;
}

Json row_json(const Row& row) {
  return {{"number", row.number},   {"id", row.id},
          {"variant", row.variant}, {"workflow", row.workflow.string()},
          {"set", row.overrides},   {"values", settings_json(row.values)},
          {"repeat", row.repeat},   {"disturbed", settings_json(row.disturbed)},
          {"nodes", row.nodes},     {"problem", row.problem},
          {"code", row.code}};
}

Row row_from(const Json& json) {
  return {.number = index_from(json.at("number")),
          .id = json.at("id"),
          .variant = json.at("variant"),
          .workflow = json.at("workflow").get<std::string>(),
          .overrides = json.at("set").get<std::vector<std::string>>(),
          .values = settings_from(json.at("values")),
          .repeat = index_from(json.at("repeat")),
          .disturbed = settings_from(json.at("disturbed")),
          .nodes = indices_from(json.at("nodes")),
          .problem = json.at("problem"),
          .code = small_from(json.at("code"))};
}

}  // namespace

Json to_json(const Plan& plan) {
  Json inputs = Json::array(), rows = Json::array(), nodes = Json::array();
  for (const Input& i : plan.inputs)
    inputs.push_back({{"name", i.name},
                      {"settings", i.settings},
                      {"unit", i.unit ? Json(*i.unit) : Json(nullptr)},
                      {"sampled", i.sampled}});
  for (const Row& row : plan.rows) rows.push_back(row_json(row));
  for (const Node& node : plan.nodes) nodes.push_back(node_json(node));
  return {{"schema", kSchema},
          {"name", plan.name},
          {"description", plan.description},
          {"file", plan.file.string()},
          {"keep", kKeeps[static_cast<std::size_t>(plan.keep)]},
          {"disk_bytes", plan.disk_bytes},
          {"stage_seconds", plan.limits.stage_seconds},
          {"results", plan.analysis.results},
          {"thresholds", settings_json(plan.analysis.thresholds)},
          {"seed", plan.analysis.seed},
          {"inputs", inputs},
          {"rows", rows},
          {"nodes", nodes}};
}

Plan plan_from(const Json& json) {
  validate(json.at("schema") == kSchema, "another program wrote it");
  Plan plan;
  plan.name = json.at("name");
  plan.description = json.at("description");
  plan.file = json.at("file").get<std::string>();
  const auto keep = std::find(kKeeps.begin(), kKeeps.end(), json.at("keep").get<std::string>());
  validate(keep != kKeeps.end(), "'keep' is none");
  plan.keep = static_cast<Keep>(keep - kKeeps.begin());
  plan.disk_bytes = json.at("disk_bytes");
  plan.limits.stage_seconds = json.at("stage_seconds");
  plan.analysis.results = json.at("results").get<std::vector<std::string>>();
  plan.analysis.thresholds = settings_from(json.at("thresholds"));
  plan.analysis.seed = whole_number(json.at("seed"));
  for (const Json& i : json.at("inputs")) {
    Input& input = plan.inputs.emplace_back();
    input.name = i.at("name");
    input.settings = i.at("settings").get<std::vector<std::string>>();
    if (!i.at("unit").is_null()) input.unit = i.at("unit").get<std::string>();
    input.sampled = i.at("sampled");
    for (const std::string& path : input.settings)
      validate(is_path(path), "'{}' is no path of a setting", path);
  }
  for (const Json& node : json.at("nodes")) {
    plan.nodes.push_back(node_from(node));
    for (const std::size_t before : plan.nodes.back().before)
      validate(before < plan.nodes.size() - 1, "a stage comes before what feeds it");
  }
  for (const Json& row : json.at("rows")) {
    plan.rows.push_back(row_from(row));
    for (const std::size_t node : plan.rows.back().nodes)
      validate(node < plan.nodes.size(), "a row names a stage that is not there");
  }
  for (const Node& node : plan.nodes)
    validate(node.row < plan.rows.size(), "a stage names a row that is not there");
  return plan;
}

}  // namespace flowslide::study
