#include "workflows/engine/record.hpp"

#include "core/check.hpp"
#include "core/files.hpp"
#include "core/hash.hpp"
#include "workflows/engine/names.hpp"

#include <algorithm>
#include <sstream>
#include <stdexcept>

namespace fs = std::filesystem;

namespace flowslide {
namespace {

constexpr int kRecordSchema = 2;
constexpr std::uint64_t kLongestFacts = 64u << 20;

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

std::string text_of(const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) text += line + "\n";
  return text;
}

void expect_inside(const std::string& path) {
  validate(stays_inside(path), "'{}' leaves the folder", path);
}

void check_names(const StageRecord& r) {
  validate(is_name(r.stage), "'{}' cannot be a stage's name", r.stage);
  validate(is_digest(r.key), "'{}' cannot be a key", r.key);
  for (const OutputRecord& o : r.outputs) {
    expect_inside(o.file);
    validate(is_digest(o.sha256), "'{}' cannot be a checksum", o.sha256);
  }
  for (const std::string& file : r.publish) expect_inside(file);
  for (const std::string& file : r.give) expect_inside(file);
  for (const FileRecord& file : r.files) expect_inside(file.name);
}

FileRecord describe(const fs::path& folder, const std::string& name) {
  HashedFile file = hash_file(folder / name);
  return {.name = name, .bytes = file.state.size, .sha256 = std::move(file.sha256)};
}

const FileRecord* find_file(const std::vector<FileRecord>& files, std::string_view name) {
  const auto it =
      std::find_if(files.begin(), files.end(), [&](const FileRecord& f) { return f.name == name; });
  return it == files.end() ? nullptr : &*it;
}

void insert_sorted(std::vector<FileRecord>& files, FileRecord file) {
  const auto less = [](const FileRecord& a, const FileRecord& b) { return a.name < b.name; };
  files.insert(std::lower_bound(files.begin(), files.end(), file, less), std::move(file));
}

/// The facts of a record whose other entries are there.
std::string read_facts(const fs::path& folder, const StageRecord& record) {
  const FileRecord* facts = find_file(record.files, kFactsFile);
  validate(facts, "{} is missing in the record", kFactsFile);
  const fs::path path = folder / kFactsFile;
  validate(is_there(path), "{} is missing", kFactsFile);
  const std::string text = read_file(path, kLongestFacts);
  validate(sha256(text) == facts->sha256, "the content of {} has changed", kFactsFile);
  const auto json = parse_object(text);
  validate(json.has_value(), "{} is no JSON object", kFactsFile);
  return json->dump();
}

}  // namespace

Json to_json(const StageRecord& r) {
  Json outputs = Json::array();
  for (const OutputRecord& o : r.outputs)
    outputs.push_back({{"port", o.port}, {"file", o.file}, {"sha256", o.sha256}});
  return {{"stage", r.stage},
          {"uses", r.uses},
          {"version", r.version},
          {"key", r.key},
          {"settings", lines_of(r.settings)},
          {"inputs", r.inputs},
          {"outputs", outputs},
          {"publish", r.publish},
          {"give", r.give},
          {"program", r.program},
          {"seconds", r.seconds}};
}

StageRecord record_from(const Json& j) {
  StageRecord r{.stage = j.at("stage"),
                .uses = j.at("uses"),
                .version = 0,
                .key = j.at("key"),
                .settings = text_of(j.at("settings")),
                .inputs = j.at("inputs"),
                .outputs = {},
                .files = {},
                .publish = j.at("publish"),
                .give = j.at("give"),
                .facts = "{}",
                .program = j.at("program"),
                .seconds = j.at("seconds")};
  const std::uint64_t version = whole_number(j.at("version"));
  validate(version < 1'000'000, "{} cannot be a version", version);
  r.version = static_cast<int>(version);
  for (const Json& o : j.at("outputs"))
    r.outputs.push_back({.port = o.at("port"), .file = o.at("file"), .sha256 = o.at("sha256")});
  check_names(r);
  return r;
}

std::string stage_key(const StageType& type, const std::string& settings,
                      const std::map<std::string, std::string>& inputs) {
  std::string text =
      fmt::format("key 1\nstage {}\nversion {}\n{}", type.name, type.version, settings);
  for (const auto& [port, hash] : inputs) text += fmt::format("input {} {}\n", port, hash);
  return sha256(text);
}

std::vector<FileRecord> list_files(const fs::path& folder) {
  std::vector<FileRecord> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.is_directory() && !entry.is_symlink()) continue;
    if (entry.is_symlink() || !entry.is_regular_file())
      throw FileError(fmt::format("'{}' is no file (results hold files and folders only)",
                                  entry.path().string()));
    files.push_back(describe(folder, entry.path().lexically_relative(folder).generic_string()));
  }
  std::sort(files.begin(), files.end(),
            [](const FileRecord& a, const FileRecord& b) { return a.name < b.name; });
  return files;
}

std::string content_hash(const std::vector<FileRecord>& files, const std::string& file_or_folder) {
  if (const FileRecord* file = find_file(files, file_or_folder)) return file->sha256;
  const std::string prefix = file_or_folder + "/";
  std::string listing;
  for (const FileRecord& file : files)
    if (file.name.starts_with(prefix))
      listing += fmt::format("{} {}\n", file.sha256, file.name.substr(prefix.size()));
  return sha256(listing);
}

void write_record(const fs::path& folder, StageRecord& record) {
  const auto facts = parse_object(record.facts);
  if (!facts)
    throw std::logic_error(fmt::format("facts of stage {} are no JSON object", record.stage));
  write_file(folder / kFactsFile, json_text(*facts));
  insert_sorted(record.files, describe(folder, std::string(kFactsFile)));
  Json json = {{"schema", kRecordSchema}};
  json.update(to_json(record));
  json["files"] = Json::array();
  for (const FileRecord& file : record.files)
    json["files"].push_back({{"name", file.name}, {"bytes", file.bytes}, {"sha256", file.sha256}});
  write_file(folder / kRecordFile, seal(json));
}

RecordRead read_stage_record(const fs::path& folder) {
  const SealedJson file = read_sealed(folder / kRecordFile);
  if (!file.json) {
    if (!file.problem.empty() || !is_there(folder)) return {{}, file.problem};
    return {{}, fmt::format("{} is missing", kRecordFile)};
  }
  StageRecord record;
  const auto cannot_be_used = [](const std::exception& e) {
    return RecordRead{{}, fmt::format("{} cannot be used ({})", kRecordFile, e.what())};
  };
  try {
    validate(file.json->at("schema") == kRecordSchema, "another program wrote it");
    record = record_from(*file.json);
    for (const Json& f : file.json->at("files"))
      record.files.push_back(
          {.name = f.at("name"), .bytes = whole_number(f.at("bytes")), .sha256 = f.at("sha256")});
    check_names(record);
  } catch (const Json::exception& e) {
    return cannot_be_used(e);
  } catch (const InputError& e) {
    return cannot_be_used(e);
  }
  try {
    record.facts = read_facts(folder, record);
  } catch (const InputError& e) {
    return {{}, e.what()};
  }
  return {std::move(record), {}};
}

Verified verify(const StageRecord& record, const fs::path& folder, const Between& between) {
  Verified result;
  const auto problem = [&](std::string text) { result.problems.push_back(std::move(text)); };
  for (const FileRecord& file : record.files) {
    const fs::path path = folder / file.name;
    const fs::file_type type = type_of(path);
    if (type == fs::file_type::not_found) {
      problem(fmt::format("{} is missing", file.name));
    } else if (type != fs::file_type::regular) {
      problem(fmt::format("{} is no file", file.name));
    } else if (const FileState state = file_state(path); state.size != file.bytes) {
      problem(fmt::format("{} has {} bytes, not {}", file.name, state.size, file.bytes));
    } else if (HashedFile now = hash_file(path, between); now.sha256 != file.sha256) {
      problem(fmt::format("the content of {} has changed", file.name));
    } else {
      result.files.push_back(std::move(now));
    }
  }
  return result;
}

std::vector<HashedFile> files_of_output(const std::vector<HashedFile>& files,
                                        const fs::path& file_or_folder) {
  std::vector<HashedFile> found;
  const std::string prefix = file_or_folder.string() + "/";
  for (const HashedFile& file : files)
    if (file.path == file_or_folder || file.path.string().starts_with(prefix))
      found.push_back(file);
  return found;
}

}  // namespace flowslide
