#pragma once
#include <atomic>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

/// All that the program knows of whoever runs jobs on a cluster. docs/adr/0017-clusters.md
namespace flowslide::study {

/// A command that a scheduler runs later, on another machine, or on many: each task of an array
/// gets its number, from 0, as one more argument.
struct Script {
  std::string name;                 ///< of its files: "rows"
  std::string study;                ///< name of the study
  std::string about;                ///< one line for who reads the script
  std::filesystem::path folder;     ///< absolute; script and logs lie there
  std::filesystem::path directory;  ///< absolute; where the command runs
  std::vector<std::string> command;
  std::size_t tasks = 1;  ///< more: an array
  bool resumes = true;    ///< it keeps what it has at SIGTERM, ends with 130, and can go on later
  std::size_t cpus = 1;
  double memory = 1e9;      ///< [bytes]
  double seconds = 3600.0;  ///< limit of a task
};

/// A task that waits or runs.
struct QueuedTask {
  std::string job;               ///< as in `after` of another
  std::filesystem::path script;  ///< as it was sent
  std::size_t task = 0;
  bool running = false;
  bool ending = false;  ///< it has been told to end, and has not yet
};

/// Another scheduler is another function that returns this.
struct Scheduler {
  std::string name;    ///< of the folder with the scripts: DIR/slurm
  std::string ending;  ///< of the scripts: ".sbatch"
  std::function<std::string(const Script&)> text;
  /// What a person would type to send scripts in turn, each after all before it.
  std::function<std::string(const std::vector<Script>&, const std::vector<std::string>& after)>
      commands;
  /// Sends a script that is on the disk, to begin when the jobs `after` have ended, however they
  /// ended. Its number. Throws FileError with what the scheduler said.
  std::function<std::string(const Script&, const std::vector<std::string>& after)> send;
  /// Of this user, of whatever kind. Throws FileError.
  std::function<std::vector<QueuedTask>()> queue;
  std::string follow;  ///< how to look at jobs: "squeue --me"
};

}  // namespace flowslide::study
