#pragma once
#include "workflows/engine/stage.hpp"

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace flowslide {

inline constexpr std::string_view kRecordFile = "stage.json";

/// An output of a stage as it was when the stage ended.
struct OutputRecord {
  std::string port;
  std::string file;           ///< name in the stage's folder
  std::string sha256;         ///< of the content; of names and contents for a folder
  std::uint64_t bytes = 0;    ///< sum over the files of a folder
  std::int64_t modified = 0;  ///< [ns] of the file system's clock; latest file of a folder
};

/// Everything that made a result: stage.json in the folder of the result, and an entry of run.lock.
struct StageRecord {
  std::string stage;  ///< its name in the workflow
  std::string uses;   ///< the stage's type
  int version = 0;
  std::string key;                            ///< see stage_key
  std::string settings;                       ///< canonical text
  std::map<std::string, std::string> inputs;  ///< sha256 by port
  std::vector<OutputRecord> outputs;
  std::vector<std::string> publish;
  std::string facts = "{}";  ///< JSON object; facts.json
  std::string program;       ///< program_version() of the program that ran it
  double seconds = 0.0;      ///< wall time of all sessions that worked on it [s]
};

/// DIR/run.lock: which results the run folder stands for at present.
struct RunLock {
  std::string workflow;
  std::string file;                    ///< workflow file, absolute
  std::vector<std::string> overrides;  ///< --set options
  bool complete = false;               ///< false while stages are still to run
  std::vector<std::string> published;  ///< names at the top of DIR
  std::map<std::string, StageRecord> stages;
};

/// Changes whenever a new result could differ: stage type and version, settings, contents of the
/// inputs. Paths, names of stages, threads and dates do not count. 64 hexadecimal digits.
std::string stage_key(const StageType& type, const std::string& settings,
                      const std::map<std::string, std::string>& inputs);

/// SHA-256 of a file, or of the sorted names and contents of a folder. Throws FileError.
std::string content_hash(const std::filesystem::path& path);

/// Size and time of the last change, of a file or of all files of a folder.
OutputRecord describe_output(const Port& port, const std::filesystem::path& folder);

/// Why the files of `folder` are no longer those of the record; empty if they are. Contents are
/// only read where size is right and time is not.
std::optional<std::string> damage(const StageRecord& record, const std::filesystem::path& folder);

/// Written by way of a temporary file, so that no reader ever sees half of it. Throws FileError.
void write_atomically(const std::filesystem::path& path, std::string_view text);

void write_record(const std::filesystem::path& folder, const StageRecord& record);
/// Empty if there is none that this program can read.
std::optional<StageRecord> read_record(const std::filesystem::path& folder);

void write_lock(const std::filesystem::path& run_folder, const RunLock& lock);
std::optional<RunLock> read_lock(const std::filesystem::path& run_folder);

}  // namespace flowslide
