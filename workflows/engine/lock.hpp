#pragma once
#include "workflows/engine/record.hpp"

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace flowslide {

/// Something of a result that appears at the top of the run folder.
struct Publication {
  std::string name;    ///< at the top
  std::string target;  ///< relative to the run folder
  bool operator==(const Publication&) const = default;
};

/// DIR/run.lock: which results the run folder stands for at present.
struct RunLock {
  std::string workflow;
  std::string file;                    ///< workflow file, absolute
  std::vector<std::string> overrides;  ///< --set options
  bool complete = false;               ///< false while stages are still to run
  std::vector<Publication> published;
  std::map<std::string, std::string> given;  ///< sha256 as given, by name relative to DIR
  std::map<std::string, StageRecord> stages;
};

void write_lock(const std::filesystem::path& run_folder, const RunLock& lock);

struct LockRead {
  std::optional<RunLock> lock;
  std::string problem;  ///< "run.lock is damaged (...)"; empty too if there is none
};

/// A lock with a name that would leave the run folder is refused as a whole.
LockRead read_lock(const std::filesystem::path& run_folder);

}  // namespace flowslide
