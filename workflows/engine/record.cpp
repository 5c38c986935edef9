#include "workflows/engine/record.hpp"

#include "core/check.hpp"
#include "core/hash.hpp"

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <fcntl.h>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <unistd.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace fs = std::filesystem;

namespace flowslide {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kRecordSchema = 1;
constexpr std::string_view kFactsFile = "facts.json";
constexpr std::string_view kLockFile = "run.lock";

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

Json to_json(const StageRecord& r) {
  Json outputs = Json::array();
  for (const OutputRecord& o : r.outputs)
    outputs.push_back({{"port", o.port},
                       {"file", o.file},
                       {"sha256", o.sha256},
                       {"bytes", o.bytes},
                       {"modified_ns", o.modified}});
  return {{"stage", r.stage},
          {"uses", r.uses},
          {"version", r.version},
          {"key", r.key},
          {"settings", lines_of(r.settings)},
          {"inputs", r.inputs},
          {"outputs", outputs},
          {"publish", r.publish},
          {"program", r.program},
          {"seconds", r.seconds}};
}

StageRecord record_from(const Json& j) {
  StageRecord r{.stage = j.at("stage"),
                .uses = j.at("uses"),
                .version = j.at("version"),
                .key = j.at("key"),
                .settings = text_of(j.at("settings")),
                .inputs = j.at("inputs"),
                .outputs = {},
                .publish = j.at("publish"),
                .facts = "{}",
                .program = j.at("program"),
                .seconds = j.at("seconds")};
  for (const Json& o : j.at("outputs"))
    r.outputs.push_back(
        {o.at("port"), o.at("file"), o.at("sha256"), o.at("bytes"), o.at("modified_ns")});
  return r;
}

/// Names in a file system need not be UTF-8; JSON text must be.
std::string json_text(const Json& json) {
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::optional<Json> read_json(const fs::path& path) {
  std::ifstream in(path);
  if (!in) return std::nullopt;
  Json json = Json::parse(in, nullptr, false);
  if (!json.is_object()) return std::nullopt;
  return json;
}

[[noreturn]] void cannot(std::string_view what, const fs::path& path) {
  throw FileError(fmt::format("{}: cannot {} ({})", path.string(), what, std::strerror(errno)));
}

/// All regular files below a folder, sorted by name; the path itself if it is a file.
std::vector<fs::path> files_of(const fs::path& path) {
  if (!fs::is_directory(path)) return {path};
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(path))
    if (entry.is_regular_file()) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

}  // namespace

std::string stage_key(const StageType& type, const std::string& settings,
                      const std::map<std::string, std::string>& inputs) {
  std::string text =
      fmt::format("key 1\nstage {}\nversion {}\n{}", type.name, type.version, settings);
  for (const auto& [port, hash] : inputs) text += fmt::format("input {} {}\n", port, hash);
  return sha256(text);
}

std::string content_hash(const fs::path& path) {
  if (!fs::is_directory(path)) return sha256_file(path);
  std::string listing;
  for (const fs::path& file : files_of(path))
    listing +=
        fmt::format("{} {}\n", sha256_file(file), file.lexically_relative(path).generic_string());
  return sha256(listing);
}

OutputRecord describe_output(const Port& port, const fs::path& folder) {
  OutputRecord r{.port = port.name, .file = port.file, .sha256 = {}, .bytes = 0, .modified = 0};
  for (const fs::path& file : files_of(folder / port.file)) {
    r.bytes += fs::file_size(file);
    const auto time = std::chrono::file_clock::to_sys(fs::last_write_time(file));
    r.modified = std::max<std::int64_t>(
        r.modified,
        std::chrono::duration_cast<std::chrono::nanoseconds>(time.time_since_epoch()).count());
  }
  return r;
}

std::optional<std::string> damage(const StageRecord& record, const fs::path& folder) {
  for (const OutputRecord& output : record.outputs) {
    const fs::path path = folder / output.file;
    if (!fs::exists(path)) return fmt::format("result is missing {}", output.file);
    const OutputRecord now = describe_output({output.port, {}, output.file}, folder);
    if (now.bytes != output.bytes)
      return fmt::format("result was damaged: {} has {} bytes, not {}", output.file, now.bytes,
                         output.bytes);
    if (now.modified != output.modified && content_hash(path) != output.sha256)
      return fmt::format("result was damaged: the content of {} has changed", output.file);
  }
  return std::nullopt;
}

void write_atomically(const fs::path& path, std::string_view text) {
  const fs::path temporary = path.string() + ".partial";
  const int file = ::open(temporary.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (file < 0) cannot("write", temporary);
  for (std::size_t done = 0; done < text.size();) {
    const ssize_t n = ::write(file, text.data() + done, text.size() - done);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) {
      ::close(file);
      cannot("write", temporary);
    }
    done += static_cast<std::size_t>(n);
  }
  if (::close(file) != 0) cannot("write", temporary);
  if (::rename(temporary.c_str(), path.c_str()) != 0) cannot("write", path);
}

void write_record(const fs::path& folder, const StageRecord& record) {
  const Json facts = Json::parse(record.facts, nullptr, false);
  if (!facts.is_object())
    throw std::logic_error(fmt::format("facts of stage {} are no JSON object", record.stage));
  write_atomically(folder / kFactsFile, json_text(facts));
  Json json = {{"schema", kRecordSchema}};
  json.update(to_json(record));
  write_atomically(folder / kRecordFile, json_text(json));
}

std::optional<StageRecord> read_record(const fs::path& folder) {
  const auto json = read_json(folder / kRecordFile);
  const auto facts = read_json(folder / kFactsFile);
  if (!json || !facts) return std::nullopt;
  try {
    if (json->at("schema") != kRecordSchema) return std::nullopt;
    StageRecord record = record_from(*json);
    record.facts = facts->dump();
    return record;
  } catch (const Json::exception&) {
    return std::nullopt;
  }
}

void write_lock(const fs::path& run_folder, const RunLock& lock) {
  Json stages = Json::object();
  for (const auto& [name, record] : lock.stages) stages[name] = to_json(record);
  const Json json = {{"schema", kRecordSchema},   {"workflow", lock.workflow},
                     {"file", lock.file},         {"set", lock.overrides},
                     {"complete", lock.complete}, {"published", lock.published},
                     {"stages", stages}};
  write_atomically(run_folder / kLockFile, json_text(json));
}

std::optional<RunLock> read_lock(const fs::path& run_folder) {
  const auto json = read_json(run_folder / kLockFile);
  if (!json) return std::nullopt;
  try {
    if (json->at("schema") != kRecordSchema) return std::nullopt;
    RunLock lock{.workflow = json->at("workflow"),
                 .file = json->at("file"),
                 .overrides = json->at("set"),
                 .complete = json->at("complete"),
                 .published = json->at("published"),
                 .stages = {}};
    for (const auto& [name, record] : json->at("stages").items())
      lock.stages[name] = record_from(record);
    return lock;
  } catch (const Json::exception&) {
    return std::nullopt;
  }
}

}  // namespace flowslide
