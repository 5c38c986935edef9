#include "constitutive/left_to_points.hpp"
#include "constitutive/point_config.hpp"
#include "core/check.hpp"
#include "core/elementary.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace flowslide {
namespace {

/// Volumetric strain, compression positive, of elastic consolidation without lateral strain, as in
/// the gravity stage of OpenSees and of fem.run.
template <class M>
double consolidation_strain(const typename M::Params& p, const PointStress& s) {
  const Elasticity e = rest_elasticity<M>(p, s.k0 / (1.0 + s.k0));
  return s.vertical / (e.bulk + 4.0 / 3.0 * e.shear);
}

template <class M>
typename M::State consolidated(const typename M::Params& p, const typename M::Constants& c,
                               const Stress<2>& sigma, const PointStress& s) {
  if constexpr (ShakingModel<M>)
    return rest_state<M>(p, c, sigma, s.compacts ? consolidation_strain<M>(p, s) : 0.0);
  else
    return M::initial_state(p);
}

/// Of the present state where the law tells it, else of its parameters.
template <class M>
Elasticity present_elasticity(const typename M::Params& p, const typename M::Constants& c,
                              const Stress<2>& sigma, const typename M::State& state) {
  if constexpr (requires { M::elasticity(c, state, sigma); })
    return M::elasticity(c, state, sigma);
  else
    return M::elasticity(p);
}

std::string kpa(double stress) { return fmt::format("{:.4g} kPa", 1e-3 * stress); }

/// The test would begin from another stress than that which is told.
template <class M>
void check_carried(const typename M::Constants& c, const typename M::State& state,
                   const Stress<2>& sigma, const PointStress& s) {
  if constexpr (AdmitsStress<M>) {
    constexpr double kSlack = 1e-3;  // of the strength
    const AdmissibleStress a = M::admissible(c, state, sigma, LiquefiedReturn::mean_stress);
    validate(a.before <= kSlack,
             "stress: {} cannot carry {} vertical, {} horizontal and {} shear (that is beyond its "
             "strength, and the test would begin from another stress) bring k0 nearer to 1, "
             "lower the shear stress, or check the parameters of the law",
             M::name, kpa(s.vertical), kpa(s.k0 * s.vertical), kpa(s.shear));
  }
}

/// PM4Sand holds what it cannot carry at the start outside of the law.
template <class M>
void warn_of_held(const typename M::State& state, std::vector<std::string>& warnings) {
  if constexpr (requires { state.held_p; }) {
    const double shear = hypot(state.held.d, state.held.t);
    if (shear > 0.0 || state.held_p != 0.0)
      warnings.push_back(fmt::format(
          "stress: {} cannot carry all of the stress at the start: {} of shear and {} of mean "
          "stress stay outside of the law. Strengths and cycles are not those of this soil; is "
          "the stress right?",
          M::name, kpa(shear), kpa(std::abs(state.held_p))));
  }
}

template <class M>
PointUnderTest point_with(const typename M::Params& p, const PointStress& s,
                          std::vector<std::string>& warnings) {
  // A point follows strains and stresses, not time.
  if constexpr (requires { M::rate_dependent; })
    throw InputError(fmt::format(
        "material.{0}: the stress of {0} depends on the rate of strain (a point is driven without "
        "time). Use a law that does not, such as {1}",
        M::name, MohrCoulomb::name));
  const double lateral = -s.k0 * s.vertical;
  const Stress<2> sigma{{lateral, -s.vertical, lateral, s.shear}};
  using State = typename M::State;
  const auto c = shaking_constants<M>(p);
  const State start = consolidated<M>(p, c, sigma, s);
  const std::string_view missing = left_to_points<M>(start);
  if constexpr (ShakingModel<M>)
    validate(missing.empty(),
             "material.{}: the state at the start has no '{}' (some parameter is far from those of "
             "soil) check them",
             M::name, missing);
  else
    validate(missing.empty(),
             "material.{}: '{}' is missing (in a run every point brings its own; here there is one "
             "point) give it",
             M::name, missing);
  check_carried<M>(c, start, sigma, s);
  warn_of_held<M>(start, warnings);
  return make_point(
      sigma, start,
      [c](const Stress<2>& stress, const State& state, const StrainIncrement<2>& de) {
        if constexpr (ShakingModel<M>)
          return M::update(c, state, stress, de);
        else
          return update_law<M, 2, double>(c, state, stress, de, 0.0);
      },
      [c, p](const Stress<2>& stress, const State& state) {
        return present_elasticity<M>(p, c, stress, state);
      });
}

PointUnderTest point_of(const PointConfig& config, PointReport& report) {
  return std::visit(
      [&]<class M>(const Material<M>& material) {
        report.law = M::name;
        return point_with<M>(material.params, config.stress, report.warnings);
      },
      make_material(config.material.laws, "material"));
}

void add_shear_facts(const ShearTest& test, const PointShear& shear, bool cyclic,
                     PointReport& report) {
  const auto add = [&report](std::string name, std::string text) {
    report.facts.emplace_back(std::move(name), std::move(text));
  };
  const ShearRecord& last = test.records.back();
  add("ended", test.end == ShearEnd::stop_strain
                   ? fmt::format("at the shear strain {:.4g}", last.gamma)
                   : fmt::format("after {} cycles", 0.5 * last.half_cycles));
  std::size_t peak = 0;
  double r_u_max = 0.0;
  for (std::size_t i = 0; i < test.records.size(); ++i) {
    if (std::abs(test.records[i].tau) > std::abs(test.records[peak].tau)) peak = i;
    r_u_max = std::max(r_u_max, pore_pressure_ratio(test, i));
  }
  add("largest shear stress",
      fmt::format("{} at the shear strain {:.4g}", kpa(std::abs(test.records[peak].tau)),
                  test.records[peak].gamma));
  if (!shear.drained) {
    add("largest r_u", fmt::format("{:.3f}", r_u_max));
    for (std::size_t i = 0; i < test.records.size(); ++i)
      if (pore_pressure_ratio(test, i) >= 0.7) {
        add("r_u = 0.7 first",
            cyclic ? fmt::format("after {:.1f} cycles", 0.5 * test.records[i].half_cycles)
                   : fmt::format("at the shear strain {:.4g}", test.records[i].gamma));
        break;
      }
  } else {
    add("vertical strain at the end", fmt::format("{:.4g} (compression positive)", -last.eps_yy));
  }
  if (!cyclic) {
    add("shear stress at the end", kpa(last.tau));
    return;
  }
  for (const double strain : {0.01, 0.03, 0.05})
    if (strain <= shear.stop_strain * (1.0 + 1e-6)) {
      const auto n = cycles_to_strain(test.records, strain);
      add(fmt::format("cycles to {:.0f} % strain", 100.0 * strain),
          n ? fmt::format("{:.1f}", *n) : std::string("not reached"));
    }
  if (test.end == ShearEnd::half_cycles && last.half_cycles >= 2) {
    const Loop loop = last_loop(test);
    add("secant modulus of the last loop", kpa(loop.secant_modulus));
    add("damping ratio of the last loop", fmt::format("{:.4f}", loop.damping));
  }
}

/// Steps that are long beside a cycle carry the test beyond where it should have turned.
void warn_of_overshoot(const ShearTest& test, const SimpleShear& asked, PointReport& report) {
  constexpr double kMost = 0.02;
  double stress = 0.0, strain = 0.0;
  for (std::size_t i = 1; i < test.records.size(); ++i) {
    const ShearRecord& r = test.records[i - 1];
    if (test.records[i].half_cycles == r.half_cycles) continue;
    stress = std::max(stress, std::abs(r.tau));
    strain = std::max(strain, std::abs(r.gamma));
  }
  const auto tell = [&](double reached, double wanted, const std::string& what) {
    if (reached > (1.0 + kMost) * wanted)
      report.warnings.push_back(fmt::format(
          "simple_shear: shearing turned at up to {}, {:.2g} times what was asked for: a step of "
          "{:g} is too long for so small a cycle. Lower strain_step.",
          what, reached / wanted, asked.strain_step));
  };
  if (asked.reversal_stress) tell(stress, *asked.reversal_stress, kpa(stress));
  if (asked.reversal_strain)
    tell(strain, *asked.reversal_strain, fmt::format("a shear strain of {:.3g}", strain));
}

void run_shear(PointUnderTest& point, const PointConfig& config, PointReport& report) {
  const PointShear& shear = *config.simple_shear;
  SimpleShear test{.drained = shear.drained,
                   .strain_step = shear.strain_step,
                   .reversal_stress = shear.reversal_stress,
                   .reversal_strain = shear.reversal_strain,
                   .stop_strain = shear.stop_strain,
                   .max_half_cycles = 2 * shear.max_cycles};
  if (shear.csr) test.reversal_stress = *shear.csr * config.stress.vertical;
  const bool cyclic = test.reversal_stress || test.reversal_strain;
  // Strain-controlled loops go as far as their reversal, not to the strain at which others stop.
  if (test.reversal_strain) test.stop_strain = 1.01 * *test.reversal_strain;
  const ShearTest result = run_simple_shear(point, test);
  for (const ShearRecord& r : result.records)
    report.rows.push_back({r.gamma, 0.0, r.eps_yy, r.sigma_xx, r.sigma_yy, r.tau, r.half_cycles});
  warn_of_overshoot(result, test, report);
  add_shear_facts(result, shear, cyclic, report);
}

/// The prescription of one of `left` remaining steps, so that stresses are reached on a straight
/// line from where they are.
Prescribed part(const std::optional<double>& strain, const std::optional<double>& stress,
                double now, int left, int steps) {
  if (stress) return Prescribed::stress_value(now + (*stress - now) / left);
  return Prescribed::strain_increment(strain.value_or(0.0) / steps);
}

void run_path(PointUnderTest& point, const PointConfig& config, PointReport& report) {
  PointRow row{0.0, 0.0, 0.0, point.stress[0], point.stress[1], point.stress[3], 0};
  report.rows.push_back(row);
  for (std::size_t l = 0; l < config.path.size(); ++l) {
    const PointLeg& leg = config.path[l];
    for (int step = 0; step < leg.steps; ++step) {
      const int left = leg.steps - step;
      const Stress<2>& s = point.stress;
      const std::array<Prescribed, 3> wish{
          part(leg.strain_xx, leg.stress_xx, s[0], left, leg.steps),
          part(leg.strain_yy, leg.stress_yy, s[1], left, leg.steps),
          part(leg.gamma_xy, leg.tau_xy, s[3], left, leg.steps)};
      try {
        const StrainIncrement<2> de = divided_step(point, wish, 1e-5 * config.stress.vertical);
        row.eps_xx += de[0];
        row.eps_yy += de[1];
        row.gamma += de[3];
      } catch (const NumericsError& e) {
        throw NumericsError(
            fmt::format("leg {} of the path, step {}: {}", l + 1, step + 1, e.what()));
      }
      row.sigma_xx = point.stress[0];
      row.sigma_yy = point.stress[1];
      row.tau = point.stress[3];
      row.half_cycles = static_cast<int>(l);
      if (!std::isfinite(row.sigma_xx + row.sigma_yy + row.tau))
        throw NumericsError(
            fmt::format("leg {} of the path, step {}: the stress is not finite. "
                        "Take smaller steps, and check the units of the parameters",
                        l + 1, step + 1));
      report.rows.push_back(row);
    }
    report.facts.emplace_back(
        fmt::format("after leg {}", l + 1),
        fmt::format("sigma'_xx {}, sigma'_yy {}, tau {}, strains {:.4g}, {:.4g}, gamma {:.4g}",
                    kpa(row.sigma_xx), kpa(row.sigma_yy), kpa(row.tau), row.eps_xx, row.eps_yy,
                    row.gamma));
  }
}

}  // namespace

PointReport run_point(const PointConfig& config) {
  check(config);
  PointReport report;
  PointUnderTest point = point_of(config, report);
  report.facts.emplace_back("law", report.law);
  report.facts.emplace_back(
      "consolidated to",
      fmt::format("{} vertical, {} horizontal, {} shear", kpa(config.stress.vertical),
                  kpa(config.stress.k0 * config.stress.vertical), kpa(config.stress.shear)));
  if (config.simple_shear)
    run_shear(point, config, report);
  else
    run_path(point, config, report);
  report.facts.emplace_back("steps", fmt::format("{}", report.rows.size() - 1));
  return report;
}

std::string point_csv(const PointReport& report) {
  std::string text = "gamma,eps_xx,eps_yy,sigma_xx_pa,sigma_yy_pa,tau_pa,r_u,half_cycles\n";
  const double start = report.rows.front().sigma_yy;
  for (const PointRow& r : report.rows)
    text += fmt::format("{:.9g},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g},{:.6f},{}\n", r.gamma, r.eps_xx,
                        r.eps_yy, r.sigma_xx, r.sigma_yy, r.tau, 1.0 - r.sigma_yy / start,
                        r.half_cycles);
  return text;
}

}  // namespace flowslide
