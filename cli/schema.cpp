#include "cli/command.hpp"
#include "cli/study_schema.hpp"
#include "cli/usage.hpp"
#include "core/files.hpp"
#include "workflows/engine/stage.hpp"
#include "workflows/stages/stage_list.hpp"

#include <filesystem>
#include <memory>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace flowslide::cli {
namespace {

using Json = nlohmann::ordered_json;

/// The stage types as alternatives; an editor completes settings once `uses` is written.
Json stage_schema(const StageType& type) {
  Json in = {{"type", "object"}, {"additionalProperties", false}, {"properties", Json::object()}};
  Json required = Json::array();
  for (const Port& port : type.inputs) {
    in["properties"][port.name] = {{"type", "string"},
                                   {"description", "stage.port of kind " + port.kind}};
    required.push_back(port.name);
  }
  in["required"] = required;
  return {{"if", {{"properties", {{"uses", {{"const", type.name}}}}}}},
          {"then",
           {{"properties",
             {{"uses", {{"const", type.name}, {"description", type.doc}}},
              {"in", in},
              {"with", Json::parse(type.json_schema())}}}}}};
}

Json workflow_schema(const std::vector<StageType>& types) {
  Json names = Json::array(), rules = Json::array();
  for (const StageType& type : types) {
    names.push_back(type.name);
    rules.push_back(stage_schema(type));
  }
  const Json stage = {
      {"type", "object"},
      {"required", {"uses"}},
      {"properties", {{"uses", {{"enum", names}}}, {"in", {{"type", "object"}}}, {"with", true}}},
      {"additionalProperties", false},
      {"allOf", rules}};
  return {
      {"$schema", "https://json-schema.org/draft/2020-12/schema"},
      {"title", "flowslide workflow"},
      {"type", "object"},
      {"required", {"schema", "name", "stages"}},
      {"additionalProperties", false},
      {"properties",
       {{"schema", {{"const", 1}}},
        {"name", {{"type", "string"}, {"pattern", "^[A-Za-z0-9][A-Za-z0-9_-]*$"}}},
        {"description", {{"type", "string"}}},
        {"stages", {{"type", "object"}, {"minProperties", 1}, {"additionalProperties", stage}}}}}};
}

std::string stage_page(const StageType& type) {
  std::string page = type.manual(type.name);
  page += fmt::format("\n{}\n\n| port | direction | kind | file |\n|---|---|---|---|\n", type.doc);
  for (const Port& port : type.inputs)
    page += fmt::format("| `{}` | in | {} | |\n", port.name, port.kind);
  for (const Port& port : type.outputs)
    page += fmt::format("| `{}` | out | {} | `{}` |\n", port.name, port.kind, port.file);
  return page;
}

}  // namespace

void add_schema(CLI::App& app, Command& action) {
  CLI::App* command = app.add_subcommand("schema", "Print the JSON Schema of workflow files");
  const auto of_studies = std::make_shared<bool>(false);
  command->add_flag("--study", *of_studies, "of study files instead");
  command->callback([of_studies, &action] {
    action = [of_studies] {
      fmt::print("{}\n", *of_studies ? study_schema() : workflow_schema(all_stages()).dump(2));
      return 0;
    };
  });
}

void add_docs(CLI::App& app, Command& action) {
  auto folder = std::make_shared<std::string>();
  CLI::App* command = app.add_subcommand("docs", "Write the manual pages of all stages");
  command->add_option("folder", *folder, "folder of the pages, DIR")
      ->required()
      ->check(output_name());
  command->callback([folder, &action] {
    action = [folder] {
      make_folders(*folder);
      for (const StageType& type : all_stages())
        write_file(std::filesystem::path(*folder) / ("stage-" + type.name + ".md"),
                   stage_page(type));
      return 0;
    };
  });
}

}  // namespace flowslide::cli
