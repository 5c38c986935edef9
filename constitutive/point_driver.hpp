#pragma once
#include "constitutive/concept.hpp"

#include <cmath>
#include <functional>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

/// Drives one material point along a path of strains, stresses, or both: the laboratory of the
/// constitutive laws. Stress is effective, tension positive, Pa; shear strain is engineering.
namespace flowslide {

/// What the driver needs of a point; `make_point` makes one from any law.
struct PointUnderTest {
  /// Stress after an increment from the committed state; nothing is remembered.
  std::function<Stress<2>(const StrainIncrement<2>&)> trial;
  /// Takes the increment; returns the new stress.
  std::function<Stress<2>(const StrainIncrement<2>&)> advance;
  /// Present elastic constants [Pa].
  std::function<Elasticity()> elasticity;
  Stress<2> stress;  ///< committed
};

/// `update(stress, state, de)` returns something with members `stress` and `state`;
/// `elasticity(stress, state)` the present elastic constants.
template <class State, class Update, class Elastic>
PointUnderTest make_point(const Stress<2>& stress, const State& state, Update update,
                          Elastic elasticity) {
  struct Memory {
    Stress<2> stress;
    State state;
  };
  const auto memory = std::make_shared<Memory>(Memory{stress, state});
  return {[memory, update](const StrainIncrement<2>& de) {
            return update(memory->stress, memory->state, de).stress;
          },
          [memory, update](const StrainIncrement<2>& de) {
            const auto r = update(memory->stress, memory->state, de);
            memory->stress = r.stress;
            memory->state = r.state;
            return r.stress;
          },
          [memory, elasticity] { return elasticity(memory->stress, memory->state); }, stress};
}

/// One component of a step: prescribed strain increment, or prescribed stress at its end.
struct Prescribed {
  enum class Kind { strain, stress } kind = Kind::strain;
  double value = 0.0;  ///< increment [-], or stress [Pa]
  static Prescribed strain_increment(double de) { return {Kind::strain, de}; }
  static Prescribed stress_value(double sigma) { return {Kind::stress, sigma}; }
};

/// One mixed step in xx, yy, xy (zz strain is zero); Newton with a secant matrix on the stress
/// components, to `tolerance` [Pa]. Returns the strain increment taken.
/// Throws NumericsError where the prescribed stress cannot be reached; the point is then as before.
StrainIncrement<2> mixed_step(PointUnderTest& point, const std::array<Prescribed, 3>& step,
                              double tolerance);

/// As mixed_step, but a step that fails is taken in two halves, and those again, down to a 256th:
/// near a reversal the law is far stiffer on one side than on the other, and Newton's method may
/// circle. After a NumericsError the point stands where the last part left it.
StrainIncrement<2> divided_step(PointUnderTest& point, const std::array<Prescribed, 3>& step,
                                double tolerance);

/// Strains are sums of steps: what they may be short of a round number, relative.
inline constexpr double kSumSlack = 1e-6;

/// Every step of a test is kept.
inline constexpr std::size_t kMostPointSteps = 20'000'000;

/// Direct simple shear from a consolidated stress: undrained at constant volume (both normal
/// strains zero), drained at constant vertical stress and no lateral strain.
struct SimpleShear {
  bool drained = false;
  double strain_step = 5e-6;                ///< |increment of gamma| of a step
  std::optional<double> reversal_stress;    ///< |tau| at which shearing turns [Pa]
  std::optional<double> reversal_strain;    ///< |gamma| at which it turns
  double stop_strain = 0.03;                ///< ends when |gamma| reaches it
  int max_half_cycles = 1000;               ///< ends after as many reversals
  std::size_t max_steps = kMostPointSteps;  ///< a test that needs more is refused
};

struct ShearRecord {
  double gamma;                    ///< shear strain
  double sigma_xx, sigma_yy, tau;  ///< [Pa], tension positive
  double eps_yy;                   ///< vertical strain since the start
  int half_cycles;                 ///< reversals so far
};

enum class ShearEnd { stop_strain, half_cycles };

struct ShearTest {
  std::vector<ShearRecord> records;  ///< the first is the start, then one a step
  ShearEnd end;
};

/// Runs the test; with neither reversal it is monotonic.
/// Throws InputError for a step, stop or reversal that is not positive and for too many steps;
/// NumericsError as mixed_step or when the stress is no longer finite, with the step and the
/// strain.
ShearTest run_simple_shear(PointUnderTest& point, const SimpleShear& test);

/// Cycles, counted in halves by reversals, before |gamma| first reaches `strain`; empty if it never
/// does.
template <class Record>
std::optional<double> cycles_to_strain(const std::vector<Record>& records, double strain) {
  for (const Record& r : records)
    if (std::abs(r.gamma) >= strain * (1.0 - kSumSlack)) return 0.5 * r.half_cycles;
  return std::nullopt;
}

/// r_u = 1 - sigma'_v/sigma'_v0 of a record.
double pore_pressure_ratio(const ShearTest& test, std::size_t record);

/// Secant shear modulus [Pa] and damping ratio of the closed loop made by the last two half cycles.
struct Loop {
  double secant_modulus, damping;
};
/// Throws InputError if the test has fewer than three reversals.
Loop last_loop(const ShearTest& test);

}  // namespace flowslide
