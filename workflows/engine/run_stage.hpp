#pragma once
#include "workflows/engine/cache.hpp"
#include "workflows/engine/graph.hpp"
#include "workflows/engine/runner.hpp"
#include "workflows/engine/stage_inputs.hpp"

#include <vector>

namespace flowslide {

/// A result that lies in the run folder.
struct StageState {
  StageRecord record;
  std::vector<HashedFile> files;
};

/// Runs one stage in its work folder and turns that into a result. The rename is the moment from
/// which the result exists. FileError, and no result, if a file that the settings name or an input
/// was written meanwhile.
StageState run_stage(const WorkflowStage& stage, const Decision& decision,
                     const StageInputs& inputs, const RunOptions& options, const RunEvents& events);

}  // namespace flowslide
