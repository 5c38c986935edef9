#pragma once
#include "core/progress.hpp"
#include "fem/config.hpp"
#include "model/ground_motion.hpp"
#include "model/history.hpp"
#include "model/section_mesh.hpp"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

/// The stage of shaking: a section and a motion become a FemHistory.
namespace flowslide {

struct FemFacts {
  double end_time = 0.0;              ///< [s]
  double largest_displacement = 0.0;  ///< of a node of the section against the base, at the end [m]
  bool stopped = false;               ///< by stop_displacement
  bool stopped_by_rule = false;       ///< by the rule given to the run
  std::int64_t steps = 0;
  double smallest_step = 0.0, largest_step = 0.0;  ///< [s]
  double out_of_balance = 0.0;                     ///< before shaking, over the largest weight
  double energy_error = 0.0;                       ///< balance over the work done
  double base_work = 0.0;                          ///< by the motion [J/m]
  double damping_work = 0.0;                       ///< lost in dashpots and Rayleigh damping [J/m]
  double kinetic_energy = 0.0;                     ///< at the end [J/m]
  double sub_steps = 0.0;                          ///< of PM4Sand
  double floored = 0.0;         ///< sub-steps that ended at the floor of mean stress
  std::int64_t iterations = 0;  ///< of implicit steps
  int most_iterations = 0;      ///< in an implicit step that converged
  std::int64_t cut_steps = 0;   ///< implicit steps that did not converge and were halved
  double seconds = 0.0;         ///< wall time of the steps
  std::vector<std::string> notes;
};

struct FemPaths {
  std::filesystem::path history;     ///< the FemHistory to write
  std::filesystem::path checkpoint;  ///< written now and then; read first if it exists
};

/// A reason to end a run that is none of this module's business.
struct StopRule {
  /// What the rule was made from; a checkpoint of a run with another is refused.
  std::string settings;
  /// Asked with the state at rest, whose answer does not count, and with every recorded state in
  /// turn; true ends the run there. A continued run shows it the states of before again. Empty: no
  /// rule.
  std::function<bool(const FemFrame&)> ends;
};

/// Runs gravity and shaking and writes the history, without the free-field columns. Displacements
/// count from the end of gravity and hold the motion of the base. With an existing checkpoint of
/// the same run, continues from it: history and facts are then bit for bit those of an
/// uninterrupted run, wall time apart. Throws InputError, NumericsError naming element and time,
/// FileError, Interrupted.
FemFacts run_fem(const SectionMesh& section, const GroundMotion& motion, const FemConfig& config,
                 const FemPaths& paths, int threads, const Progress& progress,
                 const StopRule& rule = {});

}  // namespace flowslide
