#pragma once
#include "workflows/engine/graph.hpp"
#include "workflows/engine/record.hpp"

#include <map>
#include <string>
#include <vector>

namespace flowslide {

/// What a stage takes from those before it.
struct StageInputs {
  std::map<std::string, std::string> hashes;  ///< by port, and of what else its key follows from
  PortPaths paths;
  std::vector<HashedFile> files;           ///< below these paths, as they were when last read
  std::vector<std::string> warnings = {};  ///< of the stages before it
  std::vector<EarlierStage> earlier = {};
};

/// All but paths and files, as far as `results` (by index of stage; null where a result is still to
/// be made) tells: alike for a run and for a study, so that the same stage has the same key in
/// both.
StageInputs inputs_before(const Workflow& workflow, const WorkflowStage& stage,
                          const std::vector<const StageRecord*>& results,
                          const std::filesystem::path& run_folder);

}  // namespace flowslide
