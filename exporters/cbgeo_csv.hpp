#pragma once
#include "model/particle_set.hpp"

#include <array>
#include <filesystem>
#include <string_view>

namespace flowslide {

/// Columns of a CB-Geo particle table in the order of the published script: that of the HDF5 record
/// (cb-geo/mpm, particles<step>.h5) but with status before cell_id.
inline constexpr std::array<std::string_view, 53> kCbgeoColumns{
    "id",        "mass",           "volume",         "pressure",       "coord_x",   "coord_y",
    "coord_z",   "displacement_x", "displacement_y", "displacement_z", "nsize_x",   "nsize_y",
    "nsize_z",   "velocity_x",     "velocity_y",     "velocity_z",     "stress_xx", "stress_yy",
    "stress_zz", "tau_xy",         "tau_yz",         "tau_xz",         "strain_xx", "strain_yy",
    "strain_zz", "gamma_xy",       "gamma_yz",       "gamma_xz",       "epsilon_v", "status",
    "cell_id",   "material_id",    "nstate_vars",    "svars_0",        "svars_1",   "svars_2",
    "svars_3",   "svars_4",        "svars_5",        "svars_6",        "svars_7",   "svars_8",
    "svars_9",   "svars_10",       "svars_11",       "svars_12",       "svars_13",  "svars_14",
    "svars_15",  "svars_16",       "svars_17",       "svars_18",       "svars_19"};

/// Writes plane-strain points as CSV with a header line of these columns. SI units, tension
/// positive, total stress. Numbers have the shortest text that reads back to the same double, in
/// the spelling of Python's repr, as the script writes them; cell_id is 2^64-1 (unknown), status 1,
/// nsize sqrt(volume). Strains, svars_*, nstate_vars and material_id come from the history arrays
/// of these names and are 0 without one; material_id is then the index of the material.
/// Throws FileError; InputError for dim != 2.
void write_cbgeo_csv(const std::filesystem::path& path, const ParticleSet& particles);

}  // namespace flowslide
