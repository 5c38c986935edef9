#pragma once
#include "model/particle_set.hpp"
#include "model/rest_rule.hpp"

#include <array>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

/// Frames and time series of a runout. On disk: HDF5, kind "mpm_history", particles in order of id.
namespace flowslide {

/// State of all particles at one instant, in order of id. Those that left through the outlet keep
/// the state in which they left, but for their volume.
struct MpmFrame {
  double time = 0.0;                            ///< [s] since transfer
  std::vector<std::array<double, 3>> position;  ///< [m]
  std::vector<std::array<double, 3>> velocity;  ///< [m/s]
  std::vector<std::array<double, 6>> stress;    ///< total [Pa]
  std::vector<double> volume;                   ///< [m3]; 0 once it left through the outlet
  std::vector<double> plastic_strain;           ///< accumulated deviatoric plastic strain eps_q [-]
  std::vector<double> strength;                 ///< present undrained strength or cohesion [Pa]
};

/// One row per output of the time series; masses and energies per metre of width in plane strain.
/// Works and the change of recoverable energy include what left through the outlet, `kinetic` does
/// not; the front counts points that left with the place where they did.
struct MpmSample {
  double time = 0.0;
  double runout = 0.0;         ///< [m] past ParticleSet::toe, by the fifth-farthest point
  double front = 0.0;          ///< x of the fifth-farthest point [m]
  double kinetic = 0.0;        ///< kinetic energy [J]
  double gravity_work = 0.0;   ///< work of gravity since the start [J]
  double strain_energy = 0.0;  ///< change of recoverable energy since the start [J]
  double plastic_work = 0.0;   ///< dissipated in the material [J]
  double friction_work = 0.0;  ///< dissipated on the boundary [J]
  double damping_work = 0.0;  ///< dissipated by artificial damping and by the velocity transfer [J]
  double energy_error = 0.0;  ///< residual of the balance / work of gravity [-]
  double momentum_error = 0.0;  ///< residual of the impulse balance / total impulse of gravity [-]
  double mass_error = 0.0;      ///< relative
  double max_speed = 0.0;       ///< [m/s]
  double dt = 0.0;              ///< time step [s]
  double active_particles = 0.0;    ///< share of particles not asleep [-]
  double points_left = 0.0;         ///< number of points that left through the outlet
  double mass_left = 0.0;           ///< their mass [kg]
  double kinetic_left = 0.0;        ///< kinetic energy with which they left [J]
  double strain_energy_left = 0.0;  ///< recoverable energy with which they left [J]
  double momentum_left_x = 0.0;     ///< momentum with which they left [N s]
  double momentum_left_y = 0.0;     ///< likewise, vertical [N s]
  double load_work = 0.0;           ///< work of tractions since the start [J]
  /// Fronts by mass and the height (model/front.hpp) of the materials that count [m].
  double front_equal_mass = 0.0, front_995 = 0.0, front_99 = 0.0, front_95 = 0.0, height = 0.0;
};

struct SampleColumn {
  const char* name;
  const char* unit;  ///< of the whole width in three dimensions, else per metre of it
  double MpmSample::*value;
};

/// The one list of them: what is stored, and what tables show.
inline constexpr std::array<SampleColumn, 27> kSampleColumns{
    {{"time", "s", &MpmSample::time},
     {"runout", "m", &MpmSample::runout},
     {"front", "m", &MpmSample::front},
     {"kinetic", "J", &MpmSample::kinetic},
     {"gravity_work", "J", &MpmSample::gravity_work},
     {"strain_energy", "J", &MpmSample::strain_energy},
     {"plastic_work", "J", &MpmSample::plastic_work},
     {"friction_work", "J", &MpmSample::friction_work},
     {"damping_work", "J", &MpmSample::damping_work},
     {"energy_error", "-", &MpmSample::energy_error},
     {"momentum_error", "-", &MpmSample::momentum_error},
     {"mass_error", "-", &MpmSample::mass_error},
     {"max_speed", "m/s", &MpmSample::max_speed},
     {"dt", "s", &MpmSample::dt},
     {"active_particles", "-", &MpmSample::active_particles},
     {"points_left", "-", &MpmSample::points_left},
     {"mass_left", "kg", &MpmSample::mass_left},
     {"kinetic_left", "J", &MpmSample::kinetic_left},
     {"strain_energy_left", "J", &MpmSample::strain_energy_left},
     {"momentum_left_x", "N s", &MpmSample::momentum_left_x},
     {"momentum_left_y", "N s", &MpmSample::momentum_left_y},
     {"load_work", "J", &MpmSample::load_work},
     {"front_equal_mass", "m", &MpmSample::front_equal_mass},
     {"front_995", "m", &MpmSample::front_995},
     {"front_99", "m", &MpmSample::front_99},
     {"front_95", "m", &MpmSample::front_95},
     {"height", "m", &MpmSample::height}}};
static_assert(sizeof(MpmSample) == kSampleColumns.size() * sizeof(double), "a column is missing");

/// A MpmHistory of a run that may be killed and continued. While it is written, `path`.partial is a
/// folder with frames and rows in files that only grow. Throws FileError, and NumericsError for
/// numbers that are not finite.
class MpmHistoryWriter {
 public:
  /// @param frames, samples already there: they are compared with their checksums and kept, what
  ///   comes behind is dropped. Without frames the folder is made anew.
  MpmHistoryWriter(const std::filesystem::path& path, const ParticleSet& initial,
                   const RestRule& rest, std::size_t frames = 0, std::size_t samples = 0);
  ~MpmHistoryWriter();
  MpmHistoryWriter(const MpmHistoryWriter&) = delete;
  MpmHistoryWriter& operator=(const MpmHistoryWriter&) = delete;
  void append(const MpmFrame& frame);
  void append(const MpmSample& sample);
  /// Data reach the disk; called before a checkpoint that refers to them.
  void flush();
  /// Makes `path` from the folder.
  void finish();
  /// Removes the folder, after finish() and when the checkpoint is gone: a kill between the two
  /// leaves a run that can be continued.
  void remove_parts();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

class MpmHistory {
 public:
  explicit MpmHistory(const std::filesystem::path& path);
  ~MpmHistory();
  MpmHistory(MpmHistory&&) noexcept;
  MpmHistory& operator=(MpmHistory&&) noexcept;
  /// The particles as they were handed over, in order of id: material, mass, initial state, toe.
  [[nodiscard]] const ParticleSet& initial() const;
  /// What the run ended by, if it did not end by its time.
  [[nodiscard]] const RestRule& rest() const;
  [[nodiscard]] std::size_t num_frames() const;
  [[nodiscard]] const std::vector<double>& times() const;  ///< of the frames [s]
  [[nodiscard]] MpmFrame frame(std::size_t index) const;
  /// A frame with time, position, velocity and strength only: half of what there is to read.
  [[nodiscard]] MpmFrame motion(std::size_t index) const;
  [[nodiscard]] const std::vector<MpmSample>& samples() const;

 private:
  [[nodiscard]] MpmFrame read(std::size_t index, bool motion_only) const;
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace flowslide
