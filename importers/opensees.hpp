#pragma once
#include "config/schema.hpp"
#include "core/progress.hpp"
#include "importers/mesh_text.hpp"
#include "importers/recorder_times.hpp"
#include "model/history.hpp"

#include <array>
#include <cstddef>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

/// Text and CSV recorders of an OpenSees u-p model of four-node elements, docs/guide/opensees.md.
namespace flowslide {

/// Units of the files; OpenSees itself knows none.
struct OpenSeesUnits {
  std::string length;
  std::string time;
  std::string stress;
};

/// What the columns of one node or one element are, in order. A name that appears several times
/// (four Gauss points) is averaged, which for the four points of a bilinear quadrilateral is the
/// value at the centre. `ratio` and `skip` are passed over.
struct OpenSeesColumns {
  bool time = true;
  std::vector<std::string> displacement = {"x", "y"};
  std::vector<std::string> velocity = {"x", "y"};
  std::vector<std::string> pore_pressure = {"p"};
  std::vector<std::string> stress = {"xx", "yy", "xy"};
  std::vector<std::string> strain = {"xx", "yy", "xy"};
};

/// The state at rest before the motion.
struct OpenSeesGravity {
  InputFile stress;
  std::optional<InputFile> strain;
  InputFile pore_pressure;
  std::string row = "last";  ///< last, first, or a number from 1; the same row of all files
};

inline constexpr std::array<std::string_view, 3> kStageChoices = {"only", "first", "last"};

struct OpenSeesShaking {
  InputFile displacement;
  InputFile velocity;
  InputFile pore_pressure;
  InputFile stress;
  InputFile strain;
  StageChoice stage = StageChoice::only;
  std::optional<double> interval;  ///< between rows, for files without a time column [s]
};

/// How the out-of-plane effective stress is obtained. PM4Sand has none: its mean stress is
/// p = (sigma_xx + sigma_yy)/2, to which only `mean` is consistent.
enum class SigmaZzRule {
  mean,      ///< (sigma_xx + sigma_yy)/2
  elastic,   ///< nu (sigma_xx + sigma_yy), plane strain from rest
  k0,        ///< K0 sigma_yy
  recorded,  ///< a column zz of the recorders
};
inline constexpr std::array<std::string_view, 4> kSigmaZzRules = {"mean", "elastic", "k0",
                                                                  "recorded"};

struct SigmaZz {
  SigmaZzRule rule = SigmaZzRule::mean;
  std::optional<double> nu;
  std::optional<double> k0;
};

/// What happens at a malformed row or a value that is not finite.
enum class BadRows { error, stop };
inline constexpr std::array<std::string_view, 2> kBadRows = {"error", "stop"};

/// A material of the model: its name in later stages, and what they need of it.
struct OpenSeesMaterial {
  int tag = -1;
  double density = kUnset;         ///< [kg/m3]
  std::optional<double> porosity;  ///< [-]
};

struct OpenSeesConfig {
  MeshTextConfig mesh;
  bool mirror = false;  ///< the model has its toe on the left
  std::map<std::string, OpenSeesMaterial> materials;
  OpenSeesUnits units;
  OpenSeesColumns columns;
  OpenSeesGravity gravity;
  std::optional<OpenSeesShaking> shaking;
  SigmaZz sigma_zz;
  BadRows bad_rows = BadRows::error;
};

template <>
struct Schema<OpenSeesUnits> {
  static constexpr std::string_view doc = "Units of the recorder and mesh files.";
  static void describe(FieldVisitor& v, OpenSeesUnits& c);
};
template <>
struct Schema<OpenSeesColumns> {
  static constexpr std::string_view doc = "Columns of one node or element, in recorder order.";
  static void describe(FieldVisitor& v, OpenSeesColumns& c);
};
template <>
struct Schema<OpenSeesGravity> {
  static constexpr std::string_view doc = "Recorders of the state at rest before the motion.";
  static void describe(FieldVisitor& v, OpenSeesGravity& c);
};
template <>
struct Schema<OpenSeesShaking> {
  static constexpr std::string_view doc = "Recorders of the motion.";
  static void describe(FieldVisitor& v, OpenSeesShaking& c);
};
template <>
struct Schema<SigmaZz> {
  static constexpr std::string_view doc = "Out-of-plane effective stress.";
  static void describe(FieldVisitor& v, SigmaZz& c);
};
template <>
struct Schema<OpenSeesMaterial> {
  static constexpr std::string_view doc = "A material of the model.";
  static void describe(FieldVisitor& v, OpenSeesMaterial& c);
};
template <>
struct Schema<OpenSeesConfig> {
  static constexpr std::string_view doc = "OpenSees text recorders of a plane-strain u-p model.";
  static void describe(FieldVisitor& v, OpenSeesConfig& c);
};

/// What an import did.
struct ImportReport {
  HistoryOrigin origin;               ///< as written into the history; notes include the warnings
  std::vector<std::string> warnings;  ///< implausible but possible: signs, units, wrong responses
  std::size_t num_nodes = 0;
  std::size_t num_elements = 0;
  std::size_t num_frames = 0;  ///< of the shaking, gravity not counted
  double time_first = 0.0;     ///< [s], meaningful with num_frames > 0
  double time_last = 0.0;      ///< [s]
};

/// Checks settings that depend on each other. Throws InputError.
void check(const OpenSeesConfig& config);

/// What can be known without reading all of large files.
struct ImportPreview {
  QuadMesh mesh;
  std::vector<HistoryMaterial> materials;
  std::vector<std::string> warnings;
};

/// Reads the mesh, the first row of every recorder, and files of less than a megabyte in full: the
/// columns must be those of the mesh. Throws what import_opensees would.
ImportPreview preview_opensees(const OpenSeesConfig& config);

/// Reads mesh, gravity row and shaking rows into a FemHistory at `out`. Every file is scanned once
/// before anything is written, then the common rows are read again in lockstep: memory does not
/// grow with the number of rows (but for their times). Displacement is taken as recorded, so it
/// contains the settlement of the gravity stage if the recorder does; strain zz is zero.
/// Throws InputError (file:line, counts, tags), FileError, Interrupted.
ImportReport import_opensees(const OpenSeesConfig& config, const std::filesystem::path& out,
                             const Progress& progress = {});

}  // namespace flowslide
