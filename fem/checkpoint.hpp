#pragma once
#include "fem/config.hpp"
#include "fem/implicit.hpp"
#include "fem/solver.hpp"
#include "model/ground_motion.hpp"
#include "model/section_mesh.hpp"

#include <filesystem>
#include <string>

/// Exact image of a run between two steps: continuing from it gives the same bits as never having
/// stopped. What gravity and the settings determine is computed anew. docs/adr/0008-checkpoints.md
namespace flowslide::fem {

/// What the driver of the run remembers beside the solver.
struct RunState {
  std::int64_t output = 1;                         ///< number of the next recorded state
  int since = 0;                                   ///< steps since the last look at stiffness
  double smallest_step = 0.0, largest_step = 0.0;  ///< [s]
  double largest_displacement = 0.0;               ///< at the last recorded state [m]
  double seconds = 0.0;                            ///< wall time of the steps so far
  ImplicitRecord implicit{};
};

/// SHA-256 of all that a run starts from.
std::string fingerprint(const SectionMesh& section, const GroundMotion& motion,
                        const FemConfig& config, const std::string& stop_rule);

/// Atomically replaces `path`. Throws FileError.
void write_checkpoint(const std::filesystem::path& path, const std::string& fingerprint,
                      const Solver& s, const RunState& run);

/// Fills what a run changes. Throws FileError if the file is damaged, belongs to a run with another
/// fingerprint, or holds what this run cannot have.
void read_checkpoint(const std::filesystem::path& path, const std::string& fingerprint, Solver& s,
                     RunState& run);

/// The rest of that check: its time belongs to its number of recorded states, which are
/// `output_interval` apart until `end` [s]. Throws FileError.
void check_progress(const std::filesystem::path& path, const Solver& s, const RunState& run,
                    double end, double output_interval);

}  // namespace flowslide::fem
