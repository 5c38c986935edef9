#include "transfer/audit/audit.hpp"

#include "core/elementary.hpp"
#include "core/files.hpp"
#include "model/shape_quad.hpp"
#include "transfer/seeding/gauss_rule.hpp"

#include <algorithm>
#include <cmath>

#include <nlohmann/json.hpp>

namespace flowslide {
namespace {

using Json = nlohmann::ordered_json;

/// Momentum and energy of one element; rho_0 |J_0| is the mass per unit of natural area.
void add_motion(const SeedDomain& domain, const std::vector<Vec2>& velocity, std::size_t e,
                double share, StateIntegrals& sum) {
  const std::array<Vec2, 4> reference = corners(domain.mesh, domain.mesh.nodes, e);
  const std::array<Vec2, 4> v = corners(domain.mesh, velocity, e);
  const GaussRule rule = gauss_rule(3);
  for (int j = 0; j < 3; ++j) {
    for (int i = 0; i < 3; ++i) {
      const double m = share * rule.weight[i] * rule.weight[j] * domain.density[e] *
                       jacobian(reference, rule.point[i], rule.point[j]);
      const Vec2 u = interpolate(v, rule.point[i], rule.point[j]);
      for (int k = 0; k < 2; ++k) sum.momentum[k] += m * u[k];
      sum.speed_sum += m * hypot(u[0], u[1]);
      sum.kinetic_energy += 0.5 * m * (u[0] * u[0] + u[1] * u[1]);
    }
  }
}

/// Integral of the pore pressure over the deformed element [N m].
double pore_integral(const SeedDomain& domain, const std::vector<double>& pore_pressure,
                     std::size_t e) {
  const std::array<Vec2, 4> quad = corners(domain.mesh, domain.positions, e);
  const auto& n = domain.mesh.elements[e];
  const std::array<double, 4> u{pore_pressure[n[0]], pore_pressure[n[1]], pore_pressure[n[2]],
                                pore_pressure[n[3]]};
  const GaussRule rule = gauss_rule(2);
  double sum = 0.0;
  for (int j = 0; j < 2; ++j)
    for (int i = 0; i < 2; ++i)
      sum += interpolate(u, rule.point[i], rule.point[j]) *
             jacobian(quad, rule.point[i], rule.point[j]);
  return sum;
}

/// Friction of 0.5 stops a mass of this speed within ten micrometres [m/s].
constexpr double kAsGoodAsAtRest = 0.01;

double relative(double difference, double scale) {
  return difference == 0.0 ? 0.0 : std::abs(difference) / scale;
}

Json number(double x) { return std::isfinite(x) ? Json(x) : Json(nullptr); }

Json to_json(const OutOfBalance& o) {
  return {
      {"rms_g", number(o.rms)}, {"max_g", number(o.max)}, {"worst_m", o.worst}, {"nodes", o.nodes}};
}

}  // namespace

StateIntegrals integrate(const SeedDomain& domain, const std::vector<Vec2>& velocity,
                         const std::vector<double>& pore_pressure,
                         const std::vector<Stress<2>>& effective, bool whole_elements) {
  StateIntegrals sum;
  for (std::size_t e = 0; e < domain.mesh.num_elements(); ++e) {
    if (domain.group[e] < 0) continue;
    const std::array<Vec2, 4> quad = corners(domain.mesh, domain.positions, e);
    const double share = whole_elements ? (domain.box.contains(centroid(quad)) ? 1.0 : 0.0)
                                        : share_inside(domain, e);
    if (share == 0.0) continue;
    const double volume = share * area(quad);
    const double pore = share * pore_integral(domain, pore_pressure, e);
    sum.volume += volume;
    sum.mass += share * domain.density[e] * area(corners(domain.mesh, domain.mesh.nodes, e));
    sum.pore_pressure += pore;
    for (int i = 0; i < 4; ++i) sum.stress[i] += volume * effective[e][i] - (i < 3 ? pore : 0.0);
    sum.overburden += std::abs(volume * effective[e][1] - pore);
    add_motion(domain, velocity, e, share, sum);
  }
  return sum;
}

StateIntegrals integrate(const ParticleSet& particles) {
  StateIntegrals sum;
  for (std::size_t p = 0; p < particles.size(); ++p) {
    const double m = particles.mass[p], v = particles.volume[p];
    const auto& u = particles.velocity[p];
    sum.mass += m;
    sum.volume += v;
    sum.pore_pressure += v * particles.pore_pressure[p];
    for (int i = 0; i < 4; ++i) sum.stress[i] += v * particles.stress[p][i];
    sum.overburden += v * std::abs(particles.stress[p][1]);
    for (int k = 0; k < 2; ++k) sum.momentum[k] += m * u[k];
    sum.speed_sum += m * hypot(u[0], u[1]);
    sum.kinetic_energy += 0.5 * m * (u[0] * u[0] + u[1] * u[1]);
  }
  return sum;
}

bool TransferAudit::passed() const {
  return std::all_of(checks.begin(), checks.end(), [](const AuditCheck& c) { return c.passed(); });
}

void fill_checks(TransferAudit& audit, const StateIntegrals& fem, const StateIntegrals& mapped,
                 const StateIntegrals& returned, const AuditLimits& limits) {
  const auto compare = [&](const std::string& name, const char* unit, double a, double b,
                           double scale, double limit) {
    audit.checks.push_back({name, unit, a, b, relative(b - a, scale), limit});
  };
  const auto bound = [&](const std::string& name, const char* unit, double value, double limit) {
    audit.checks.push_back({name, unit, kUnset, value, value, limit});
  };
  compare("mass", "kg/m", fem.mass, mapped.mass, fem.mass, limits.mass);
  compare("volume", "m3/m", fem.volume, mapped.volume, fem.volume, limits.volume);
  for (int k = 0; k < 2; ++k)
    compare(k == 0 ? "momentum_x" : "momentum_y", "kg/s", fem.momentum[k], mapped.momentum[k],
            fem.speed_sum, limits.momentum);
  compare("kinetic_energy", "J/m", fem.kinetic_energy, mapped.kinetic_energy,
          std::max(fem.kinetic_energy, 0.5 * fem.mass * kAsGoodAsAtRest * kAsGoodAsAtRest),
          limits.kinetic_energy);
  compare("pore_pressure", "N", fem.pore_pressure, mapped.pore_pressure, fem.overburden,
          limits.stress);
  constexpr std::array<const char*, 4> kComponents{"xx", "yy", "zz", "xy"};
  for (int i = 0; i < 4; ++i)
    compare(std::string("stress_") + kComponents[i], "N", fem.stress[i], mapped.stress[i],
            fem.overburden, limits.stress);
  for (int i = 0; i < 4; ++i)
    compare(std::string("stress_") + kComponents[i] + "_returned", "N", fem.stress[i],
            returned.stress[i], fem.overburden, kUnset);
  double before = 0.0, after = 0.0;
  for (const AuditMaterial& m : audit.materials) {
    before = std::max(before, m.violation_before);
    after = std::max(after, m.violation_after);
  }
  bound("yield_before", "", before, kUnset);
  bound("yield_after", "", after, limits.yield);
  const bool judged = audit.at_rest && audit.mapped.nodes > 0;
  bound("out_of_balance_rms", "g", audit.mapped.rms, judged ? limits.out_of_balance_rms : kUnset);
  bound("out_of_balance_max", "g", audit.mapped.max, judged ? limits.out_of_balance_max : kUnset);
  bound("out_of_balance_rms_returned", "g", audit.returned.rms, kUnset);
  bound("out_of_balance_max_returned", "g", audit.returned.max, kUnset);
  if (audit.mapped.nodes == 0)
    audit.notes.push_back(
        "the out-of-balance acceleration was not measured: no node of the grid is surrounded by "
        "full cells");
}

void enforce(const TransferAudit& audit) {
  if (audit.passed()) return;
  std::string failed;
  bool unbalanced = false, lost = false;
  for (const AuditCheck& c : audit.checks) {
    if (c.passed()) continue;
    const bool balance = c.name.starts_with("out_of_balance");
    unbalanced = unbalanced || balance;
    lost = lost || !balance;
    failed += balance ? fmt::format("\n  {}: {:.3g} {} exceeds {:.3g}", c.name, c.particles, c.unit,
                                    c.limit)
                      : fmt::format(
                            "\n  {}: error {:.3g} exceeds {:.3g} (finite elements {:.6g}, "
                            "points {:.6g} {})",
                            c.name, c.error, c.limit, c.fem, c.particles, c.unit);
  }
  std::string advice;
  if (lost) advice += "\nUse a smaller cell or another transfer time.";
  // Stress is known once per element. A jump between two elements acts on a layer of nodes whose
  // mass falls with the cell, so that the largest acceleration grows as the cell shrinks.
  if (unbalanced)
    advice += fmt::format(
        "\nThe worst node is at ({:.2f}, {:.2f}) m. The maximum grows with 1/cell once cells are "
        "smaller than the finite elements; if the rms is small, raise audit.out_of_balance_max.",
        audit.mapped.worst[0], audit.mapped.worst[1]);
  throw NumericsError(fmt::format(
      "the transfer at t = {:.3f} s lost more than its audit allows (the runout would start from "
      "another state than the shaking left):{}{}\nThe limits are set under audit; "
      "audit.enforce: false records the failure and goes on.",
      audit.time, failed, advice));
}

void write_audit(const std::filesystem::path& path, const TransferAudit& audit) {
  Json checks = Json::array();
  for (const AuditCheck& c : audit.checks)
    checks.push_back({{"name", c.name},
                      {"unit", c.unit},
                      {"fem", number(c.fem)},
                      {"particles", number(c.particles)},
                      {"error", number(c.error)},
                      {"limit", number(c.limit)},
                      {"passed", c.passed()}});
  Json materials = Json::array();
  for (const AuditMaterial& m : audit.materials)
    materials.push_back({{"name", m.name},
                         {"points", m.points},
                         {"volume_m3_per_m", m.volume},
                         {"mass_kg_per_m", m.mass},
                         {"returned", m.returned},
                         {"violation_before", number(m.violation_before)},
                         {"violation_after", number(m.violation_after)}});
  const AuditCounts& n = audit.counts;
  const Json document{{"kind", "transfer_audit"},
                      {"time_s", audit.time},
                      {"at_rest", audit.at_rest},
                      {"passed", audit.passed()},
                      {"checks", checks},
                      {"counts",
                       {{"points", n.points},
                        {"slivers_merged", n.slivers_merged},
                        {"slivers_kept", n.slivers_kept},
                        {"moved_inside", n.moved_inside},
                        {"split_elements", n.split_elements},
                        {"stress_widened", n.stress_widened},
                        {"stress_nearest", n.stress_nearest}}},
                      {"materials", materials},
                      {"out_of_balance",
                       {{"mapped", to_json(audit.mapped)}, {"returned", to_json(audit.returned)}}},
                      {"base_displacement_m", audit.base_displacement},
                      {"base_velocity_m_per_s", audit.base_velocity},
                      {"notes", audit.notes}};
  write_file(path, document.dump(2) + '\n');
}

}  // namespace flowslide
