#include "verify/mpm/list.hpp"
#include "verify/mpm/slumps.hpp"

/// Columns that stand against a smooth wall on a rough base and collapse when the other side is let
/// go: the granular one of Bui et al. (2008), and undrained ones whose final reach and whose
/// threshold are known from plasticity.
namespace flowslide::mpm {
namespace {

constexpr double kToe = 0.442, kTop = 0.0992;  ///< of the experiment: Bui et al. (2008) [m]
constexpr double kHalving = 0.05;              ///< change of a front or height that is converged

/// What a halving of the cell changes.
template <class Deposit>
void halving(CheckList& checks, const std::string& name, const Deposit& coarse,
             const Deposit& fine) {
  checks.error(name + "_front_halving", fine.front / coarse.front - 1.0, kHalving);
  checks.error(name + "_height_halving", fine.height / coarse.height - 1.0, kHalving);
}

}  // namespace

std::vector<Check> verify_bui(std::string_view name) {
  CheckList checks(name);
  const BarDeposit coarse = collapse(Bars{.cell = 0.005}), middle = collapse(Bars{});
  halving(checks, "mu_i_first", coarse, middle);
  const BarDeposit fine = collapse(Bars{.cell = 0.00125});
  halving(checks, "mu_i_last", middle, fine);
  // The last point of the measured surface, as high as a bar.
  checks.near("mu_i_toe", fine.toe, kToe, 0.05 * kToe, "m");
  checks.near("mu_i_height", fine.height, kTop, 0.05 * kTop, "m");
  checks.error("mu_i_surface_rms", fine.surface_error, 0.03);
  checks.error("mu_i_failure_line_rms", fine.failure_error, 0.15);
  checks.error("mu_i_energy_balance", fine.energy_error, 0.01);
  // 19.8 degrees between the principal stresses, whatever the rate: the toe runs ahead.
  const BarDeposit control = collapse(Bars{.law = Friction::coulomb_principal});
  checks.at_least("control_coulomb_toe", control.toe, 1.05 * kToe, "m");
  checks.at_least("control_coulomb_surface_rms", control.surface_error, 0.03);
  return checks.take();
}

std::vector<Check> verify_undrained(std::string_view name) {
  // Lubrication theory and its slip-line correction bound the reach: docs/theory.
  struct Row {
    double aspect, b, corrected, lubrication;
  };
  CheckList checks(name);
  for (const Row& row :
       {Row{1.0, 0.05, 2.40, 2.82}, Row{1.0, 0.10, 1.72, 2.24}, Row{1.0, 0.15, 1.37, 1.96},
        Row{2.0, 0.10, 2.00, 2.82}, Row{2.0, 0.15, 1.56, 2.47}, Row{4.0, 0.15, 1.73, 3.11}}) {
    const double low = 0.95 * row.corrected, high = 1.05 * row.lubrication;
    const ClayDeposit d = collapse(Clay{.aspect = row.aspect, .b = row.b});
    checks.near(fmt::format("length_a{:g}_b{:.2f}", row.aspect, row.b), d.foremost,
                0.5 * (low + high), 0.5 * (high - low));
  }
  const ClayDeposit coarse = collapse(Clay{.cells = 10}), middle = collapse(Clay{});
  halving(checks, "a1_b0.10_first", coarse, middle);
  halving(checks, "a1_b0.10_last", middle, collapse(Clay{.cells = 40}));
  return checks.take();
}

std::vector<Check> verify_cut(std::string_view name) {
  CheckList checks(name);
  double fell = 0.0, stood = 1.0;
  for (const double b : {0.235, 0.245, 0.255, 0.265, 0.275, 0.285, 0.295}) {
    if (cut_stands(b, 16)) {
      stood = b;
      break;
    }
    fell = b;
  }
  checks.near("threshold", 0.5 * (fell + stood), 0.265, 0.01);
  return checks.take();
}

}  // namespace flowslide::mpm
