#pragma once
#include "core/hashed_file.hpp"
#include "workflows/engine/sealed_json.hpp"
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
inline constexpr std::string_view kFactsFile = "facts.json";

/// A file of a result as it was when the stage ended.
struct FileRecord {
  std::string name;  ///< relative to the result's folder, parts separated by '/'
  std::uint64_t bytes = 0;
  std::string sha256;
};

struct OutputRecord {
  std::string port;
  std::string file;    ///< file or folder in the result's folder
  std::string sha256;  ///< of the content; of names and contents for a folder
};

/// Everything that made a result: stage.json in the folder of the result, and without the list of
/// files an entry of run.lock.
struct StageRecord {
  std::string stage;  ///< its name in the workflow
  std::string uses;   ///< the stage's type
  int version = 0;
  std::string key;                            ///< see stage_key
  std::string settings;                       ///< canonical text
  std::map<std::string, std::string> inputs;  ///< sha256 by port
  std::vector<OutputRecord> outputs;
  std::vector<FileRecord> files;     ///< all but stage.json, sorted by name
  std::vector<std::string> publish;  ///< see StageResult
  std::vector<std::string> give;     ///< see StageResult
  std::string facts = "{}";          ///< JSON object; facts.json
  std::string program;               ///< program_version() of the program that ran it
  double seconds = 0.0;              ///< wall time of all sessions that worked on it [s]
};

/// Changes whenever a new result could differ: stage type and version, settings, contents of the
/// inputs. Paths, names of stages, threads and dates do not count. 64 hexadecimal digits.
std::string stage_key(const StageType& type, const std::string& settings,
                      const std::map<std::string, std::string>& inputs);

/// What a folder holds, sorted by name. FileError for anything but folders and regular files.
std::vector<FileRecord> list_files(const std::filesystem::path& folder);

/// SHA-256 of a file of the list, or of the sorted names and contents of a folder.
std::string content_hash(const std::vector<FileRecord>& files, const std::string& file_or_folder);

/// Writes facts.json and adds it to record.files, then stage.json.
void write_record(const std::filesystem::path& folder, StageRecord& record);

struct RecordRead {
  std::optional<StageRecord> record;
  std::string problem;  ///< empty too if there is no folder
};

/// Checks the text by its checksum and every name in it by names.hpp. FileError if the system
/// cannot read what is there.
RecordRead read_stage_record(const std::filesystem::path& folder);

/// The files of a result against its record.
struct Verified {
  std::vector<std::string> problems;  ///< "mpm.h5 is missing", one per file
  std::vector<HashedFile> files;      ///< those without a problem, in the order of the record
};
Verified verify(
    const StageRecord& record, const std::filesystem::path& folder, const Between& between = [] {});

/// Those of `files` that belong to an output.
std::vector<HashedFile> files_of_output(const std::vector<HashedFile>& files,
                                        const std::filesystem::path& file_or_folder);

/// A record as JSON, without facts and files; the inverse throws Json::exception or InputError.
Json to_json(const StageRecord& record);
StageRecord record_from(const Json& json);

}  // namespace flowslide
