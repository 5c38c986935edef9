#pragma once
#include "core/hashed_file.hpp"

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

/// What the work folder of a stage with checkpoints tells the session that continues it.
namespace flowslide {

inline constexpr std::string_view kSessionFile = "session.json";

struct Session {
  double seconds = 0.0;           ///< wall time that sessions spent here
  std::vector<FileState> inputs;  ///< of the files that the settings name, in their order
  bool ended = false;             ///< the last one found these files as they were at its start
};

void write_session(const std::filesystem::path& work, double seconds,
                   std::span<const HashedFile> inputs, bool ended);

struct SessionRead {
  std::optional<Session> session;
  std::string problem;  ///< why the work cannot be continued; empty too if nothing was begun
};

/// Refuses a folder with links or pipes, through which a continued stage would write elsewhere.
SessionRead read_session(const std::filesystem::path& work);

/// Was a killed session's input touched since? What it has left may come from another content.
bool is_touched(const Session& session, std::span<const HashedFile> inputs);

}  // namespace flowslide
