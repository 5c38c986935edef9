#pragma once
#include "core/check.hpp"
#include "core/voigt.hpp"
#include "transfer/audit/audit_limits.hpp"
#include "transfer/audit/out_of_balance.hpp"
#include "transfer/seeding/seed.hpp"

#include <array>
#include <filesystem>
#include <string>
#include <vector>

/// What a transfer kept and what it lost. Theory: docs/theory/transfer.md, "Audit".
namespace flowslide {

/// One conserved quantity, or one bound.
struct AuditCheck {
  std::string name;     ///< "mass", "momentum_x", "yield_after", ...
  std::string unit;     ///< of `fem` and `particles`
  double fem = kUnset;  ///< on the finite elements; unset for a bound
  double particles = 0.0;
  double error = 0.0;     ///< relative as AuditLimits says; the value itself for a bound
  double limit = kUnset;  ///< unset: reported only
  [[nodiscard]] bool passed() const { return !is_set(limit) || error <= limit; }
};

struct AuditMaterial {
  std::string name;
  int points = 0;
  double volume = 0.0;            ///< [m3] per metre of width
  double mass = 0.0;              ///< [kg] per metre of width
  int returned = 0;               ///< points whose stress was outside the yield surface
  double violation_before = 0.0;  ///< largest f / strength
  double violation_after = 0.0;
};

struct AuditCounts {
  int points = 0;
  int slivers_merged = 0;
  int slivers_kept = 0;
  int moved_inside = 0;    ///< centroids outside the material
  int split_elements = 0;  ///< re-entrant elements
  int stress_widened = 0;  ///< points whose interpolation radius had to grow
  int stress_nearest = 0;  ///< points that took the stress of their element
};

struct TransferAudit {
  double time = 0.0;  ///< of the transferred state [s]
  bool at_rest = false;
  std::vector<AuditCheck> checks;
  AuditCounts counts;
  std::vector<AuditMaterial> materials;
  OutOfBalance mapped;                        ///< before the return to the yield surface
  OutOfBalance returned;                      ///< as handed to the runout
  std::array<double, 2> base_displacement{};  ///< removed [m]
  std::array<double, 2> base_velocity{};      ///< removed [m/s]
  std::vector<std::string> notes;
  [[nodiscard]] bool passed() const;
};

/// Integrals that a transfer should keep, per metre of width.
struct StateIntegrals {
  double mass = 0.0;                 ///< [kg]
  double volume = 0.0;               ///< [m3]
  std::array<double, 2> momentum{};  ///< [kg m/s]
  double speed_sum = 0.0;            ///< integral of rho |v| [kg m/s]
  double kinetic_energy = 0.0;       ///< v^T M v / 2 with the consistent mass [J]
  std::array<double, 4> stress{};    ///< integral of total stress over the volume [N m]
  double pore_pressure = 0.0;        ///< [N m]
  double overburden = 0.0;           ///< integral of |sigma_yy| [N m]
};

/// On the finite elements inside the box. Mass from the reference configuration with the consistent
/// mass matrix; `velocity` at nodes relative to the base, `total` at element centres. Elements that
/// the box cuts count by their share inside; with `whole_elements` by their centroid.
StateIntegrals integrate(const SeedDomain& domain, const std::vector<Vec2>& velocity,
                         const std::vector<double>& pore_pressure,
                         const std::vector<Stress<2>>& effective, bool whole_elements);

StateIntegrals integrate(const ParticleSet& particles);

/// Compares the integrals and the yield violations in `audit.materials`, and the out-of-balance
/// accelerations, with the limits.
void fill_checks(TransferAudit& audit, const StateIntegrals& fem, const StateIntegrals& mapped,
                 const StateIntegrals& returned, const AuditLimits& limits);

/// Throws NumericsError listing every check that exceeds its limit.
void enforce(const TransferAudit& audit);

/// JSON; throws FileError.
void write_audit(const std::filesystem::path& path, const TransferAudit& audit);

}  // namespace flowslide
