#pragma once
#include "study/run/pool.hpp"
#include "study/run/work_costs.hpp"
#include "study/table/table.hpp"

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace flowslide::cli {

enum class StudyOutput { terminal, lines, quiet, json };

/// What of a study waits or runs on a cluster.
struct StudyQueue {
  std::string words;                                 ///< "2 tasks run, 30 wait (squeue --me)"
  std::size_t running = 0, ending = 0, waiting = 0;  ///< tasks
};

/// Tells on stdout how a study goes: on a terminal one line per running stage and a total that are
/// redrawn, elsewhere a line per stage that has ended, with json an object per line. Failures go to
/// stderr when they happen.
class StudyDisplay {
 public:
  StudyDisplay(const study::Plan& plan, const study::StudyState& progress, StudyOutput kind)
      : plan_(plan), progress_(progress), kind_(kind) {}

  void begin(const std::filesystem::path& folder);
  /// What would run, so many stages at once.
  void plan(const study::WorkCosts& costs, std::size_t jobs) const;
  [[nodiscard]] study::PoolEvents events();
  /// Takes the lines away that are redrawn.
  void close();
  void end(const std::filesystem::path& folder, const study::Table& table) const;
  void status(const std::filesystem::path& folder, double bytes,
              const std::optional<StudyQueue>& queue) const;

 private:
  void ended(const study::StageEnd& end);
  void tick(const study::PoolView& view);
  [[nodiscard]] std::string total(const study::PoolView& view) const;
  [[nodiscard]] std::string name_of(std::size_t node) const;
  /// Rows with the same cause on one line: a mistake in one setting stops many.
  enum class Failed { any, planning, running };  ///< when a row did
  [[nodiscard]] std::vector<std::string> failures(Failed which = Failed::any) const;

  const study::Plan& plan_;
  const study::StudyState& progress_;
  StudyOutput kind_;
  std::size_t drawn_lines_ = 0, ended_ = 0;
  std::chrono::steady_clock::time_point drawn_{};
};

}  // namespace flowslide::cli
