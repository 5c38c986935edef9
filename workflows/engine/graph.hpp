#pragma once
#include "workflows/engine/stage.hpp"

#include <any>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace flowslide {

/// An input port and the output that feeds it.
struct Link {
  std::string port;
  std::size_t from_stage = 0;  ///< index into Workflow::stages, smaller than that of this stage
  std::string from_port;
};

struct WorkflowStage {
  std::string name;
  StageType type;
  PreparedStage prepared;
  std::vector<Link> inputs;                ///< in the order of type.inputs
  std::any preview = {};                   ///< what its preview returned; empty if it has none
  std::vector<std::string> warnings = {};  ///< what is odd about its settings and their files
  Work work = {};                          ///< unset where only a run can tell
};

/// A workflow that can run: settings read, ports connected, stages after what feeds them.
struct Workflow {
  std::string name;
  std::filesystem::path file;
  std::vector<std::string> overrides;  ///< the --set options in force
  std::vector<WorkflowStage> stages;
};

/// The name in a workflow file, without looking at the rest of it. Throws InputError, FileError.
std::string workflow_name(const YamlNode& document);

/// Reads a workflow file, and the files it names as far as that takes seconds. Collects what is
/// wrong in all stages before it throws: InputError if any of it is wrong input, FileError if only
/// files are missing; one problem per line, each with its location and a suggestion.
Workflow load_workflow(const std::filesystem::path& path, std::span<const std::string> overrides,
                       std::span<const StageType> types);

}  // namespace flowslide
