#pragma once
#include "workflows/engine/lock.hpp"

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

/// What of the results appears at the top of the run folder.
namespace flowslide {

inline constexpr std::string_view kResultFile = "result.json";

/// What the results publish; a name that is taken gets the stage's name in front.
std::vector<Publication> publications(const std::vector<StageRecord>& records);

/// Makes a relative link at the top. A .pvd is copied and the paths inside are rewritten, since
/// ParaView reads them from where the .pvd lies. Throws FileError, also if something is there that
/// this program has not made; `ours` says that a lock knows it.
void publish(const std::filesystem::path& run_folder, const Publication& item, bool ours);

/// Removes result.json and what the lock says is published, so that nothing at the top looks
/// current while it is not. Without a lock the links into the results go.
void withdraw(const std::filesystem::path& run_folder, const std::optional<RunLock>& lock);

/// Differences between the top of the folder and what a complete lock says is there.
std::vector<std::string> problems_at_top(const std::filesystem::path& run_folder,
                                         const RunLock& lock);

using Notice = std::function<void(std::string_view)>;

/// Copies the files that a result gives to the user to the top of the run folder and notes their
/// checksums in lock.given. A file that has been edited since it was given is the user's: it stays,
/// with a notice.
void give(const std::filesystem::path& run_folder, const StageRecord& record, RunLock& lock,
          const Notice& notice);

}  // namespace flowslide
