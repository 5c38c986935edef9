#pragma once
#include "core/voigt.hpp"
#include "model/history_material.hpp"
#include "model/mesh.hpp"

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

/// What a dynamic finite-element run leaves behind, whichever program made it: the one door through
/// which shaking enters the rest of the program. On disk: one HDF5 file, kind "fem_history".
namespace flowslide {

/// One recorded instant. Nodal arrays have num_nodes entries, element arrays num_elements.
struct FemFrame {
  double time = 0.0;                  ///< [s] from the start of the motion
  std::vector<Vec2> displacement;     ///< nodes [m], from the reference coordinates
  std::vector<Vec2> velocity;         ///< nodes [m/s], absolute
  std::vector<double> pore_pressure;  ///< nodes [Pa], compression positive
  std::vector<Stress<2>> stress;      ///< element centres, effective [Pa], tension positive
  std::vector<StrainIncrement<2>>
      strain;  ///< element centres, from the reference, engineering shear
};

/// Where the data came from, copied into every later file.
struct HistoryOrigin {
  std::string program;             ///< "opensees text recorders"
  std::string sigma_zz_rule;       ///< how the out-of-plane stress was obtained, in words
  std::vector<std::string> notes;  ///< what the reader dropped or repaired, one line each
};

/// The file is there after finish(); an unfinished writer leaves nothing. Throws FileError.
class FemHistoryWriter {
 public:
  /// Throws InputError for materials that are not those of the mesh.
  FemHistoryWriter(const std::filesystem::path& path, const QuadMesh& mesh,
                   const std::vector<HistoryMaterial>& materials, const HistoryOrigin& origin);
  ~FemHistoryWriter();
  FemHistoryWriter(const FemHistoryWriter&) = delete;
  FemHistoryWriter& operator=(const FemHistoryWriter&) = delete;
  /// State at rest before the motion, the reference of r_u. Once, before the first append.
  void set_gravity(const FemFrame& frame);
  /// Times must increase. One frame is held in memory at a time.
  void append(const FemFrame& frame);
  void finish();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Opens a history read-only; frames are read when asked for. Throws FileError, InputError.
class FemHistory {
 public:
  explicit FemHistory(const std::filesystem::path& path);
  ~FemHistory();
  FemHistory(FemHistory&&) noexcept;
  FemHistory& operator=(FemHistory&&) noexcept;

  [[nodiscard]] const QuadMesh& mesh() const;
  [[nodiscard]] const std::vector<HistoryMaterial>& materials() const;  ///< by ascending tag
  [[nodiscard]] const HistoryOrigin& origin() const;
  [[nodiscard]] const FemFrame& gravity() const;
  [[nodiscard]] const std::vector<double>& times() const;  ///< [s], may be empty (gravity only)
  [[nodiscard]] FemFrame frame(std::size_t index) const;   ///< index into times()

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace flowslide
