#pragma once
#include "study/plan/study_file.hpp"
#include "workflows/engine/graph.hpp"
#include "workflows/engine/sealed_json.hpp"

#include <span>
#include <string>
#include <vector>

/// A study with every row and every stage that has to be there, before anything runs.
namespace flowslide::study {

/// A stage with its settings and all that feeds it: what several rows have in common is one node.
struct Node {
  WorkflowStage stage;              ///< without what runs it; links count in `before`
  std::vector<std::size_t> before;  ///< nodes that feed it, directly or not, in their order
  std::string recipe;               ///< SHA-256 of all the above
  std::size_t row = 0;              ///< the first that needs it
  /// Nodes whose files it reads: of its links, or of all before it.
  [[nodiscard]] std::vector<std::size_t> reads() const;
};

struct Row {
  std::size_t number = 0;  ///< from 1
  std::string id;          ///< of what is computed: the same wherever the row stands
  std::string variant;
  std::filesystem::path workflow;
  std::vector<std::string> overrides;  ///< as for --set
  Settings values;                     ///< by variable
  std::size_t repeat = 0;
  Settings disturbed;                       ///< what this realisation sets
  std::vector<std::size_t> nodes;           ///< in the order of its workflow
  std::string problem;                      ///< why it cannot be run; empty if it can
  int code = 0;                             ///< exit code of the problem
  [[nodiscard]] std::string label() const;  ///< "pga 0.3 g, c_soft 0.5, repeat 1"
};

/// A column of the table that the user has chosen.
struct Input {
  std::string name;
  std::vector<std::string> settings;
  std::optional<std::string> unit;  ///< of a number; absent for words
  bool sampled = false;
};

struct Plan {
  std::string name, description;
  std::filesystem::path file;
  Keep keep = Keep::final;
  double disk_bytes = 2e9;
  Limits limits;
  Analysis analysis;
  std::vector<Input> inputs;
  std::vector<Row> rows;
  std::vector<Node> nodes;
  std::vector<std::string> programs;  ///< that stages would start, each once
};

/// Loads the workflow of every row. A row that is wrong is in the plan, with its problem; if all
/// are, InputError with the problems.
Plan make_plan(const StudyFile& study, std::span<const StageType> types);

/// The stages up to a node as the workflow that they form, for questions to the engine.
Workflow workflow_of(const Plan& plan, std::size_t node);

/// Everything but `programs`.
Json to_json(const Plan& plan);
/// Throws Json::exception and InputError for what is no plan.
Plan plan_from(const Json& json);

}  // namespace flowslide::study
