#pragma once
#include <filesystem>
#include <string_view>

/// What flows between stages: files of a kind. A port of type Artifact<FemHistory> only connects to
/// a port of the same type.
namespace flowslide {

class FemHistory;
class MpmHistory;
struct LiquefactionZone;
struct GroundMotion;
struct SectionMesh;
struct ParticleSet;
struct TransferAudit;  ///< tag of audit.json
struct ReportFolder;   ///< tag of the folder with the report

/// Specialise for a type that may cross between stages; the name appears in messages and in the
/// files themselves.
template <class T>
inline constexpr std::string_view kArtifactKind = "";
template <>
inline constexpr std::string_view kArtifactKind<FemHistory> = "fem_history";
template <>
inline constexpr std::string_view kArtifactKind<SectionMesh> = "mesh";
template <>
inline constexpr std::string_view kArtifactKind<GroundMotion> = "motion";
template <>
inline constexpr std::string_view kArtifactKind<LiquefactionZone> = "zone";
template <>
inline constexpr std::string_view kArtifactKind<ParticleSet> = "particles";
template <>
inline constexpr std::string_view kArtifactKind<TransferAudit> = "audit";
template <>
inline constexpr std::string_view kArtifactKind<MpmHistory> = "mpm_history";
template <>
inline constexpr std::string_view kArtifactKind<ReportFolder> = "report";

/// A file or folder on disk that holds a T. In the declaration of an output: its name in the
/// stage's folder; when the stage runs: the full path.
template <class T>
struct Artifact {
  static_assert(!kArtifactKind<T>.empty(), "specialise kArtifactKind for this type");
  std::filesystem::path path;
};

}  // namespace flowslide
