#include "study/run/session_record.hpp"

#include "core/check.hpp"
#include "core/files.hpp"
#include "workflows/engine/cost_book.hpp"
#include "workflows/engine/sealed_json.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <unistd.h>

#include <fmt/format.h>

namespace fs = std::filesystem;

namespace flowslide::study {
namespace {

constexpr int kSessionSchema = 1;
constexpr std::string_view kFolder = "sessions";

double clock_seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

std::string utc_now() {
  const std::time_t now = std::time(nullptr);
  std::tm parts{};
  ::gmtime_r(&now, &parts);
  std::array<char, 32> text{};
  return {text.data(), std::strftime(text.data(), text.size(), "%Y-%m-%dT%H:%M:%SZ", &parts)};
}

/// Takes away what killed sessions of this machine were writing:
/// ".BEGAN-MACHINE-PROCESS.json.....partial".
void remove_leftovers(const fs::path& sessions) {
  std::vector<fs::path> left;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(sessions, error)) {
    const std::string name = entry.path().filename().string();
    const std::size_t dash = name.rfind('-', name.find(".json."));
    if (!name.ends_with(".partial") || dash == std::string::npos ||
        !name.substr(0, dash).ends_with("-" + machine_name()))
      continue;
    const int process = std::atoi(name.c_str() + dash + 1);
    if (process > 0 && ::kill(process, 0) != 0 && errno == ESRCH) left.push_back(entry.path());
  }
  for (const fs::path& path : left) remove_path(path);
}

SessionRecord from(const Json& j) {
  return {.began = j.at("began"),
          .program = j.at("program"),
          .processor = j.at("processor"),
          .processors = whole_number(j.at("processors")),
          .jobs = whole_number(j.at("jobs")),
          .threads = whole_number(j.at("threads")),
          .stages = whole_number(j.at("stages")),
          .wall_seconds = j.at("wall_seconds"),
          .processor_seconds = j.at("processor_seconds")};
}

}  // namespace

SessionLog::SessionLog(const fs::path& folder, SessionRecord what)
    : record_(std::move(what)), began_(clock_seconds()), used_before_(processor_time()) {
  record_.began = utc_now();
  path_ =
      folder / kFolder / fmt::format("{}-{}-{}.json", record_.began, machine_name(), ::getpid());
  remove_leftovers(path_.parent_path());
}

void SessionLog::stage_made() {
  ++record_.stages;
  record_.wall_seconds = clock_seconds() - began_;
  record_.processor_seconds = processor_time() - used_before_;
  make_folders(path_.parent_path());
  write_file(path_, seal({{"schema", kSessionSchema},
                          {"began", record_.began},
                          {"program", record_.program},
                          {"processor", record_.processor},
                          {"processors", record_.processors},
                          {"jobs", record_.jobs},
                          {"threads", record_.threads},
                          {"stages", record_.stages},
                          {"wall_seconds", record_.wall_seconds},
                          {"processor_seconds", record_.processor_seconds}}));
}

std::vector<SessionRecord> read_sessions(const fs::path& folder) {
  std::vector<SessionRecord> sessions;
  if (!is_there(folder / kFolder)) return sessions;
  for (const auto& entry : fs::directory_iterator(folder / kFolder)) {
    if (entry.path().extension() != ".json") continue;
    try {
      if (const auto json = read_sealed(entry.path()).json) sessions.push_back(from(*json));
    } catch (const Json::exception&) {
      continue;
    }
  }
  std::sort(sessions.begin(), sessions.end(),
            [](const auto& a, const auto& b) { return a.began < b.began; });
  return sessions;
}

std::string processor_name() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);)
    if (line.starts_with("model name"))
      if (const std::size_t colon = line.find(": "); colon != std::string::npos)
        return line.substr(colon + 2);
  return "unknown";
}

}  // namespace flowslide::study
