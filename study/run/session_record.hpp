#pragma once
#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

/// What a study cost and where it ran: DIR/sessions/BEGAN-MACHINE-PID.json, one for each `study
/// run` that computed something, so that two at once do not write the same file.
namespace flowslide::study {

struct SessionRecord {
  std::string began;    ///< UTC, 2025-03-01T12:00:00Z
  std::string program;  ///< program_version()
  std::string processor;
  std::size_t processors = 0;  ///< that the study might use
  std::size_t jobs = 0, threads = 0;
  std::size_t stages = 0;          ///< computed in it
  double wall_seconds = 0.0;       ///< up to the last of them
  double processor_seconds = 0.0;  ///< of all its processes that have ended, user and system
};

/// Counts from its construction on; written after every stage, as a session may be killed.
class SessionLog {
 public:
  SessionLog(const std::filesystem::path& folder, SessionRecord what);
  void stage_made();

 private:
  std::filesystem::path path_;
  SessionRecord record_;
  double began_ = 0.0, used_before_ = 0.0;  ///< [s]
};

/// In the order of their beginnings; what is damaged is left out. Throws FileError
/// and std::filesystem::filesystem_error.
std::vector<SessionRecord> read_sessions(const std::filesystem::path& folder);

/// As the system calls it; "unknown" where it does not tell.
std::string processor_name();

}  // namespace flowslide::study
