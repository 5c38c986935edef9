#pragma once
#include "core/progress.hpp"
#include "fem/anderson.hpp"
#include "fem/coupled_matrix.hpp"

#include <functional>
#include <vector>

/// Implicit steps of motion and water together, generalised trapezoidal rule: a check of the
/// explicit steps by other means. docs/theory/fem.md, "Implicit steps"
namespace flowslide::fem {

struct ImplicitSettings {
  double step = 5e-3;           ///< largest [s]
  double smallest_step = 2e-5;  ///< [s]
  double tolerance = 1e-4;      ///< largest residual, of a node's weight [-]
  int max_iterations = 40;      ///< before the step is halved
  double theta = 0.5;           ///< weight of the end of the step; 1/2 conserves energy
};

/// What a run of implicit steps remembers beside the solver.
struct ImplicitRecord {
  int halvings = 0;  ///< of the largest step, at present
  int in_a_row = 0;  ///< steps since the step last changed
  int most_iterations = 0;
  std::int64_t iterations = 0;
  std::int64_t cut = 0;  ///< steps that did not converge
};

class ImplicitSteps {
 public:
  ImplicitSteps(const Solver& s, const ImplicitSettings& settings);
  /// One step with the present moduli, not beyond `left` [s], over a base with the velocity
  /// ground(t) [m/s]. Afterwards the velocities of the state are those at its time. Throws
  /// NumericsError naming time, step and element where no step that is allowed converges; the state
  /// is then that before it. False where a stop was asked for on the way: nothing has changed.
  bool advance(Solver& s, ImplicitRecord& record, double left,
               const std::function<double(double)>& ground, const Progress& progress = {});

 private:
  struct Base {
    double end = 0.0, mean = 0.0;  ///< velocity at the end and in the mean of the step [m/s]
  };
  struct Residual {
    double largest = 0.0;       ///< over the tolerance; infinite where soil deforms too much
    std::int32_t element = -1;  ///< one at that unknown
  };
  [[nodiscard]] bool converge(Solver& s, ImplicitRecord& record, const Base& base,
                              const Progress& progress);
  /// Forces and flows of the trial in `x_`; leaves the laws of `s` at the end of the step. Does not
  /// allocate.
  [[nodiscard]] Residual evaluate(Solver& s, const Base& base);
  [[nodiscard]] bool follow_soil(Solver& s);
  void accept(Solver& s, const Base& base);

  ImplicitSettings settings_;
  CoupledMatrix matrix_;
  std::vector<double> scale_;             ///< force [N] and volume [m3] of a residual of 1
  std::vector<std::int32_t> element_at_;  ///< an element at each row of the matrix
  Anderson anderson_;
  State start_;               ///< before the step
  Eigen::VectorXd x_;         ///< velocities and pressures at the end
  Eigen::VectorXd residual_;  ///< [N], [m3/s]
  Eigen::VectorXd change_;    ///< of x_ that would take the residuals away, were the soil elastic
  Eigen::VectorXd rate_;      ///< of the pressures [Pa/s]
  Residual last_;
  std::vector<double> middle_;    ///< velocities in the mean of the step [m/s]
  std::vector<double> internal_;  ///< forces in the mean of the step [N]
  std::vector<Stress<2>> end_stress_;
  std::vector<double> end_hourglass_x_, end_hourglass_y_;
};

}  // namespace flowslide::fem
