#pragma once
#include "workflows/engine/costs.hpp"
#include "workflows/engine/graph.hpp"
#include "workflows/engine/record.hpp"

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace flowslide {

enum class Action {
  reuse,      ///< a result for exactly this key lies in the run folder, undamaged
  run,        ///< from the start
  resume,     ///< from the checkpoint of an interrupted session
  undecided,  ///< an input is still to be made; only in a plan
};

struct Decision {
  Action action = Action::run;
  std::string why;                         ///< "settings changed (c_soft_ratio 1 -> 0.5)"
  std::string key;                         ///< empty while undecided
  std::optional<StageRecord> record;       ///< of the result to reuse
  std::vector<HashedFile> files = {};      ///< of the result to reuse, just read
  std::vector<std::string> problems = {};  ///< what is wrong with a result that cannot be reused
  std::vector<std::string> warnings = {};  ///< of the result to reuse, and of the settings
  Cost expected = {};                      ///< of what has to run; unset where nobody knows
};

/// Decides about one stage, and reads every file of a result before it says that it can be reused.
/// `inputs` holds the content hash of every connected port that is known; `previous` is what the
/// run folder stood for before this call, and only explains.
Decision decide(
    const std::filesystem::path& run_folder, const WorkflowStage& stage,
    const std::map<std::string, std::string>& inputs, const std::optional<StageRecord>& previous,
    const Between& between = [] {});

/// "c_soft_ratio 1 -> 0.5, cell 1 m -> 2 m" from two canonical texts; at most three of them.
std::string describe_changes(const std::string& before, const std::string& now);

}  // namespace flowslide
