#pragma once
#include "model/history.hpp"
#include "model/mpm_history.hpp"
#include "model/particle_set.hpp"

#include <filesystem>
#include <span>
#include <string>
#include <utility>
#include <vector>

/// Files for ParaView. Names carry units: "stress [Pa]". Appended binary data, compressed, in
/// double precision, made in memory. All throw FileError.
namespace flowslide {

/// A further array of a picture; `values` has `components` numbers per node, element or particle.
struct VtkField {
  std::string name;  ///< with its unit: "r_u [-]"
  std::span<const double> values;
  int components = 1;
};

/// Particles as they were handed over, with every field and history variable. `.vtp`
void write_vtp(const std::filesystem::path& path, const ParticleSet& p,
               std::span<const VtkField> extra = {});

/// Particles of one instant: those of `frame` with the material and id of `initial`; displacement
/// is counted from the undeformed section, as in `initial`. `.vtp`
void write_vtp(const std::filesystem::path& path, const ParticleSet& initial, const MpmFrame& frame,
               std::span<const VtkField> extra = {});

/// Mesh at its reference coordinates with displacement, velocity and pore pressure at the nodes and
/// stress and strain in the elements. `.vtu`
void write_vtu(const std::filesystem::path& path, const QuadMesh& mesh, const FemFrame& frame,
               std::span<const VtkField> nodal = {}, std::span<const VtkField> elemental = {});

/// Series: time [s] and file, which is named relative to the folder of `path`. `.pvd`
void write_pvd(const std::filesystem::path& path,
               std::span<const std::pair<double, std::filesystem::path>> files);

}  // namespace flowslide
