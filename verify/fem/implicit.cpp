#include "fem/implicit.hpp"

#include "core/elementary.hpp"
#include "verify/fem/dense_assembly.hpp"
#include "verify/fem/list.hpp"
#include "verify/fem/scene.hpp"

#include <algorithm>

#include <Eigen/Dense>

/// Shaking integrated implicitly, motion and water together and with an assembly of its own: a
/// check of the explicit steps, and of the implicit ones of the program. Matrices are full.
namespace flowslide::fem {
namespace {

/// How the top moves, and r_u in the middle at the end.
struct ColumnHistory {
  std::vector<double> time, top;
  double r_u = 0.0, energy_error = 0.0;

  [[nodiscard]] double at(double t) const {
    const auto above = std::lower_bound(time.begin() + 1, time.end() - 1, t) - time.begin();
    const double share = (t - time[above - 1]) / (time[above] - time[above - 1]);
    return top[above - 1] + share * (top[above] - top[above - 1]);
  }
};

constexpr double kColumnEnd = 2.0, kColumnHeight = 10.0;
constexpr int kColumnRows = 10;

double column_motion(double t) { return 0.08 * sin(2.0 * kPi * 1.5 * t); }

Solver sand_column() {
  FemConfig c = config(sand(), kColumnHeight);
  c.damping.stiffness = 1e-3;
  return at_rest(
      section({.columns = 1, .rows = kColumnRows, .width = 2.0, .height = kColumnHeight}), c);
}

double middle_r_u(const Solver& s) {
  return (s.state.pressure[kColumnRows] - 0.5 * kColumnHeight * 9810.0) /
         (900.0 * 9.81 * 0.5 * kColumnHeight);
}

ColumnHistory shake_column_explicitly() {
  Solver s = sand_column();
  ColumnHistory h{{0.0}, {0.0}};
  while (s.state.time < kColumnEnd) {
    advance(s, {column_motion(s.state.time), column_motion(s.state.time + s.dt)});
    h.time.push_back(s.state.time);
    h.top.push_back(s.state.displacement[s.model.dof.back()[0]]);
  }
  h.r_u = middle_r_u(s);
  h.energy_error = s.state.energy.error();
  return h;
}

/// The generalised trapezoidal rule for motion and water together: theta 1/2 is of second order and
/// keeps energy, 1 is Euler's.
class Trapezoidal {
 public:
  Trapezoidal(Solver& s, double dt, double theta)
      : s_(s),
        o_(assemble(s)),
        dt_(dt),
        theta_(theta),
        n_(s.model.num_dofs + 1),
        nodes_(o_.S.rows()),
        mass_(s.layout.mass.data(), n_),
        p_(s.state.pressure.data(), nodes_),
        v_(Vector::Zero(n_)),
        u_(Vector::Zero(n_)) {
    weight_ = Eigen::Map<const Vector>(s.layout.weight.data(), n_) +
              Eigen::Map<const Vector>(s.model.load.data(), n_);
    damping_ = s.damping.stiffness * o_.K;
    damping_.diagonal() += Eigen::Map<const Vector>(s.dashpot.data(), n_);
    held_.assign(n_ + nodes_, false);
    for (Eigen::Index u = 0; u < n_; ++u) held_[u] = u + 1 == n_ || s.prescribed[u];
    for (Eigen::Index i = 0; i < nodes_; ++i)
      held_[n_ + i] = s.water.equation[i] == s.water.num_equations;
    lu_.compute(jacobian());
    force_ = deform(s, u_).force;
  }

  /// One step to t + dt, where the base moves with `ground_end`.
  void step(double t, double ground_end) {
    constexpr int kIterations = 200;
    v1_ = v_;
    p1_ = p_;
    for (Eigen::Index k = 0; k < n_; ++k)
      if (s_.prescribed[k]) v1_[k] = ground_end;
    for (int iteration = 0; !correct();)
      if (++iteration >= kIterations)
        throw NumericsError(fmt::format("implicit step at {:.4f} s does not converge", t));
    add_work();
    keep();
  }

  [[nodiscard]] const Vector& displacement() const { return u_; }
  [[nodiscard]] Energy energy() const {
    Energy e = energy_;
    e.kinetic = 0.5 * v_.dot(mass_.cwiseProduct(v_));
    return e;
  }

 private:
  /// Of the residuals with the elastic stiffness.
  [[nodiscard]] Matrix jacobian() const {
    Matrix J(n_ + nodes_, n_ + nodes_);
    J << theta_ * damping_ + theta_ * theta_ * dt_ * o_.K, -theta_ * o_.Q,
        theta_ * o_.Q.transpose(), o_.S / dt_ + theta_ * o_.H;
    for (Eigen::Index u = 0; u < n_; ++u) J(u, u) += mass_[u] / dt_;
    for (Eigen::Index k = 0; k < n_ + nodes_; ++k)
      if (held_[k]) {
        J.row(k).setZero();
        J(k, k) = 1.0;
      }
    return J;
  }
  /// One correction; true when it was small.
  bool correct() {
    middle_ = (1.0 - theta_) * v_ + theta_ * v1_;
    const Vector pressure = (1.0 - theta_) * p_ + theta_ * p1_;
    trial_ = deform(s_, dt_ * middle_);
    push_ = (1.0 - theta_) * force_ + theta_ * trial_.force - o_.Q * pressure;
    Vector R(n_ + nodes_);
    R << mass_.cwiseProduct(v1_ - v_) / dt_ + push_ + damping_ * middle_ - weight_,
        o_.S * (p1_ - p_) / dt_ + o_.H * pressure + o_.Q.transpose() * middle_ + o_.gravity_flow;
    for (Eigen::Index k = 0; k < n_ + nodes_; ++k)
      if (held_[k]) R[k] = 0.0;
    const Vector change = lu_.solve(R);
    v1_ -= change.head(n_);
    p1_ -= change.tail(nodes_);
    return change.head(n_).cwiseAbs().maxCoeff() <= 1e-7 &&
           change.tail(nodes_).cwiseAbs().maxCoeff() <= 1.0;
  }
  void add_work() {
    const Vector inertia = mass_.cwiseProduct(v1_ - v_) / dt_;
    const Vector lost = damping_ * middle_;
    for (Eigen::Index k = 0; k < n_; ++k) {
      energy_.deformation += dt_ * push_[k] * middle_[k];
      energy_.damping += dt_ * lost[k] * middle_[k];
      energy_.weight += dt_ * weight_[k] * middle_[k];
      if (s_.prescribed[k])
        energy_.base += dt_ * (inertia[k] + push_[k] + lost[k] - weight_[k]) * middle_[k];
    }
  }
  void keep() {
    s_.state.stress = trial_.stress;
    std::get<fem::LawStates<PM4Sand>>(s_.state.laws).of = trial_.sand;
    for (std::size_t e = 0; e < s_.state.hourglass_x.size(); ++e)
      for (int i = 0; i < 4; ++i) {
        const double gamma = s_.layout.elements.gamma[i][e];
        s_.state.hourglass_x[e] += gamma * dt_ * middle_[s_.layout.dofs[e][2 * i]];
        s_.state.hourglass_y[e] += gamma * dt_ * middle_[s_.layout.dofs[e][2 * i + 1]];
      }
    force_ = trial_.force;
    u_ += dt_ * middle_;
    v_ = v1_;
    p_ = p1_;
  }

  Solver& s_;
  Operators o_;
  double dt_, theta_;
  Eigen::Index n_, nodes_;
  Eigen::Map<const Vector> mass_;
  Eigen::Map<Vector> p_;  ///< pressures, those of the state
  Vector v_, u_, force_, weight_;
  Matrix damping_;
  std::vector<bool> held_;
  Eigen::PartialPivLU<Matrix> lu_;
  Vector v1_, p1_, middle_, push_;  ///< of the step that is taken
  Trial trial_;
  Energy energy_;
};

ColumnHistory shake_column_implicitly(double dt, double theta) {
  Solver s = sand_column();
  Trapezoidal rule(s, dt, theta);
  ColumnHistory h{{0.0}, {0.0}};
  for (double t = 0.0; t < kColumnEnd - 0.5 * dt; t += dt) {
    rule.step(t, column_motion(t + dt));
    h.time.push_back(t + dt);
    h.top.push_back(rule.displacement()[s.model.dof.back()[0]]);
  }
  h.r_u = middle_r_u(s);
  h.energy_error = rule.energy().error();
  return h;
}

/// The same with the implicit steps of the program.
ColumnHistory shake_column_with_program(double dt) {
  Solver s = sand_column();
  ImplicitSteps steps(s, {.step = dt, .tolerance = 1e-6});
  ImplicitRecord record;
  ColumnHistory h{{0.0}, {0.0}};
  while (s.state.time < kColumnEnd - 0.5 * dt) {
    steps.advance(s, record, kColumnEnd - s.state.time, column_motion);
    h.time.push_back(s.state.time);
    h.top.push_back(s.state.displacement[s.model.dof.back()[0]]);
  }
  h.r_u = middle_r_u(s);
  h.energy_error = s.state.energy.error();
  return h;
}

/// Root mean square difference of the top's displacement over the largest.
double top_difference(const ColumnHistory& a, const ColumnHistory& b) {
  double sum = 0.0, largest = 0.0;
  int count = 0;
  for (double t = 0.02; t < kColumnEnd - 0.02; t += 0.002, ++count) {
    sum += pow(a.at(t) - b.at(t), 2);
    largest = std::max(largest, std::abs(b.at(t)));
  }
  return std::sqrt(sum / count) / largest;
}

}  // namespace

std::vector<Check> verify_implicit(std::string_view name) {
  CheckList checks(name);
  const ColumnHistory direct = shake_column_explicitly();
  const ColumnHistory fine = shake_column_implicitly(2e-3, 0.5),
                      coarse = shake_column_implicitly(16e-3, 0.5);
  checks.at_least("r_u", direct.r_u, 0.1);
  checks.error("top", top_difference(fine, direct), 0.005);
  checks.near("r_u_implicit", fine.r_u, direct.r_u, 0.005);
  // of first order, as stress is split at reversals; the explicit steps of 0.5 ms err by 0.1 %, too
  checks.at_least("gain_by_an_eighth_of_the_step",
                  top_difference(coarse, direct) / top_difference(fine, direct), 3.0);
  checks.error("energy_explicit", direct.energy_error, 1e-8);
  checks.error("energy_implicit", fine.energy_error, 1e-6);
  const ColumnHistory program = shake_column_with_program(2e-3);
  checks.error("program_against_own_assembly", top_difference(program, fine), 1e-5);
  checks.error("energy_program", program.energy_error, 1e-6);
  // control: Euler's rule damps, and the check sees it
  checks.at_least("control", top_difference(shake_column_implicitly(2e-3, 1.0), direct), 0.01);
  return checks.take();
}

}  // namespace flowslide::fem
