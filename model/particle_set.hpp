#pragma once
#include "core/check.hpp"

#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

/// Material points between modules and on disk (HDF5, kind "particles"). The solver keeps its own
/// typed arrays; here history variables and material parameters cross by name.
namespace flowslide {

/// A material of the runout: a constitutive law by name and its parameters in SI by name.
struct MaterialSpec {
  std::string name;                          ///< "tailings", "liquefied 3", "foundation"
  std::string law;                           ///< name of the law in constitutive/materials.hpp
  std::map<std::string, double> parameters;  ///< SI, keys as in the law's schema
  bool counts_for_runout = true;             ///< false for the foundation
  bool liquefied = false;                    ///< soil that had liquefied at the transfer
};

struct ParticleSet {
  int dim = 2;
  /// Datum of the runout: x of the downstream end of the soil that counts, before deformation [m].
  double toe = kUnset;
  std::vector<std::array<double, 3>> position;      ///< [m]; third component 0 in plane strain
  std::vector<std::array<double, 3>> velocity;      ///< [m/s]
  std::vector<std::array<double, 3>> displacement;  ///< [m] since the undeformed section
  std::vector<double> mass;                         ///< [kg], per metre of width in plane strain
  std::vector<double> volume;                       ///< [m3], per metre of width in plane strain
  std::vector<std::array<double, 6>> stress;        ///< total, xx yy zz xy yz zx [Pa], tension > 0
  std::vector<double> pore_pressure;                ///< [Pa], compression > 0
  std::vector<std::int32_t> material;               ///< index into materials
  std::vector<std::int64_t> id;                     ///< unique; kept by the solver when it sorts
  std::map<std::string, std::vector<double>> history;  ///< "plastic_strain", "r_u", ...
  std::vector<MaterialSpec> materials;
  std::vector<std::string> notes;  ///< what a user of the points must know, one line each

  [[nodiscard]] std::size_t size() const { return position.size(); }
};

/// Calls f(name, unit, array) for every per-particle array but `history`: the one list of fields
/// that resize, write, read and VTK output use.
template <class Set, class F>
void visit_fields(Set& p, F&& f) {
  f(std::string_view("position"), std::string_view("m"), p.position);
  f(std::string_view("velocity"), std::string_view("m/s"), p.velocity);
  f(std::string_view("displacement"), std::string_view("m"), p.displacement);
  f(std::string_view("mass"), std::string_view("kg"), p.mass);
  f(std::string_view("volume"), std::string_view("m3"), p.volume);
  f(std::string_view("stress"), std::string_view("Pa"), p.stress);
  f(std::string_view("pore_pressure"), std::string_view("Pa"), p.pore_pressure);
  f(std::string_view("material"), std::string_view(""), p.material);
  f(std::string_view("id"), std::string_view(""), p.id);
}

void resize(ParticleSet& p, std::size_t n);

/// Equal array lengths, positive mass and volume, finite state, materials in range, unique ids.
/// Throws InputError naming the first offending particle.
void check(const ParticleSet& p);

void write_particles(const std::filesystem::path& path, const ParticleSet& p);
ParticleSet read_particles(const std::filesystem::path& path);

}  // namespace flowslide
