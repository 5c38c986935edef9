#include "constitutive/pm4sand_flow.hpp"

/// Explicit integration of PM4Sand: elastic part in closed form, then modified Euler with error
/// control in sub-steps of bounded strain. docs/theory/pm4sand.md, "Integration".
namespace flowslide {
namespace pm4sand {
namespace {

using State = PM4Sand::State;
using Constants = PM4Sand::Constants;

/// Sub-steps are not made smaller than this strain; there the error is accepted.
constexpr double kSmallestIncrement = 1e-9;
/// Bounds the work of one call, whatever it is given.
constexpr double kMaxSubSteps = 1e6;

struct Rates {
  double p = 0.0;
  Deviator s, alpha, z;
};

Rates elastic_rates(const Moduli& e, const Strain& step) {
  return {(e.K + e.G / 3.0) * step.volumetric, 2.0 * e.G * step.deviator, {}, {}};
}

struct Local {
  double p;  ///< not below p_min
  Surfaces surfaces;
  Moduli moduli;
};

Local local(const Constants& c, const State& s, double Dr, const Point& at) {
  const double p = std::max(at.p, s.p_min);
  const Surfaces f = surfaces(c, p, Dr);
  return {p, f, moduli(c, s, f, at.p, at.s)};
}

/// Increments over `step` with the flow rule at `at`, eqs (25) to (28).
Rates rates(const Constants& c, const State& s, const History& h, const Local& l, const Point& at,
            const Strain& step) {
  const Moduli& e = l.moduli;
  Rates r = elastic_rates(e, step);
  const Flow w = flow(c, s, h, l.surfaces, e, l.p, at);
  const double n_r = dot(w.n, at.s) / at.p;
  const double driving = 2.0 * e.G * dot(w.n, step.deviator) - n_r * e.K * step.volumetric;
  const double elastic = 2.0 * e.G - e.K * w.D * n_r;
  double L = driving / (w.Kp + elastic);
  if (!(L > 0.0)) return r;
  // Near the bounding surface the pull on the back-stress ratio is too stiff for explicit steps.
  // Along n it ends at the image; across n it may turn the loading direction, which changes by
  // d alpha/(m/sqrt(2)), no farther than onto alpha.
  const double along = std::min(L * w.pull, 1.0);
  const double across = std::min(L * w.pull, kRootHalf * c.m / std::max(norm(at.alpha), c.m));
  if (along == 1.0 && w.Kp > 0.0) L = std::max(L, (driving - w.Kp / w.pull) / elastic);
  r.p -= L * e.K * w.D;
  r.s = r.s - (2.0 * e.G * L) * w.n;
  r.alpha = (along * w.b_n) * w.n + across * w.b_side;
  if (w.beyond_dilatancy && w.D < 0.0) r.z = (-h.fabric_rate * L) * (s.z_max * w.n + at.z);
  return r;
}

Point moved(const Point& a, const Rates& r) {
  return {a.p + r.p, a.s + r.s, a.alpha + r.alpha, a.z + r.z};
}

/// The part of an elastic step after which the stress leaves the yield surface |s - p alpha| =
/// m p/sqrt(2) for good: the larger root of a quadratic, 1 where the step stays inside.
double elastic_part(double m, const Point& from, const Rates& step) {
  const Deviator a = from.s - from.p * from.alpha;
  const Deviator b = step.s - step.p * from.alpha;
  const double k2 = 0.5 * m * m;
  const Deviator end = a + b;
  const double p_end = from.p + step.p;
  if (p_end > 0.0 && dot(end, end) <= k2 * p_end * p_end) return 1.0;
  const double A = dot(b, b) - k2 * step.p * step.p;
  const double B = dot(a, b) - k2 * from.p * step.p;
  const double C = dot(a, a) - k2 * from.p * from.p;
  const double root2 = B * B - A * C;
  if (!(root2 > 0.0 && A > 0.0)) return 0.0;
  return std::clamp((-B + std::sqrt(root2)) / A, 0.0, 1.0);
}

/// A reversal of loading: the present back-stress ratio becomes the initial one, limited by the
/// earlier branches where the shear stress has not changed its sign.
void reverse(const Constants& c, State& s, double p, const Deviator& n) {
  s.alpha_in_p = c.opensees_reversals ? s.alpha_in : s.alpha_true;
  s.alpha_true = s.alpha;
  s.z_in = s.z;
  p = std::max(p, s.p_min);
  const double zp = norm(s.z) * p;
  if ((zp > s.z_xp && p > s.p_zp) || s.reversed == 0.0) {
    s.z_xp = zp;
    s.p_zp = p;
    s.reversed = 1.0;
  }
  const auto track = [](double in, double alpha, double& lowest, double& highest) {
    if (in > 0.0)
      lowest = std::min(lowest, alpha);
    else
      highest = std::max(highest, alpha);
  };
  track(s.alpha_in.d, s.alpha.d, s.alpha_min.d, s.alpha_max.d);
  track(s.alpha_in.t, s.alpha.t, s.alpha_min.t, s.alpha_max.t);
  const auto apparent = [](double n_i, double lowest, double highest) {
    return n_i > 0.0 ? std::max(0.0, lowest) : std::min(0.0, highest);
  };
  if (s.alpha.t * s.alpha_in_p.t > 0.0)
    s.alpha_in = {apparent(n.d, s.alpha_min.d, s.alpha_max.d),
                  apparent(n.t, s.alpha_min.t, s.alpha_max.t)};
  else
    s.alpha_in = s.alpha;
}

class Integration {
 public:
  Integration(const Constants& c, const State& s, const Point& start) : c_(c), s_(s), at_(start) {}

  void run(const Strain& whole, double size) {
    const double equal = std::ceil(size / c_.max_strain_increment * (1.0 - 1e-9));
    const double largest = 1.0 / std::clamp(equal, 1.0, kMaxSubSteps);
    const double smallest =
        std::min(largest, std::max(kSmallestIncrement / size, 1.0 / kMaxSubSteps));
    double done = 0.0, dT = largest;
    while (done < 1.0) {
      const double left = 1.0 - done;
      const bool last = dT >= left * (1.0 - 1e-12);
      const double part = last ? left : dT;
      const Strain step{part * whole.volumetric, part * whole.deviator};
      const double error = attempt(step, part <= smallest);
      const double change =
          error > 0.0 ? std::clamp(0.8 * std::sqrt(c_.tolerance / error), 0.1, 2.0) : 2.0;
      if (error > c_.tolerance && part > smallest) {
        ++rejected;
        dT = std::max(part * std::min(change, 0.8), smallest);
        continue;
      }
      ++sub_steps;
      s_.void_ratio -= (1.0 + c_.initial_void_ratio) * step.volumetric;
      accept();
      done = last ? 1.0 : done + part;
      dT = std::clamp(part * change, smallest, largest);
    }
  }

  const State& state() const { return s_; }
  const Point& point() const { return at_; }
  int sub_steps = 0, rejected = 0, floored = 0;

 private:
  /// Computes `next_`; returns its relative error. `forced`: this step is taken whatever the error.
  double attempt(const Strain& step, bool forced) {
    const double Dr = relative_density(c_, s_.void_ratio);
    const Local start = local(c_, s_, Dr, at_);
    const Rates trial = elastic_rates(start.moduli, step);
    const Deviator n = (at_.s + trial.s) - (at_.p + trial.p) * at_.alpha;
    if (dot(s_.alpha - s_.alpha_true, n) < 0.0) reverse(c_, s_, at_.p, n);

    const double a = elastic_part(c_.m, at_, trial);
    Point from = at_;
    from.p += a * trial.p;
    from.s = from.s + a * trial.s;
    Mb_ = start.surfaces.Mb;
    // G follows sqrt(p): what an elastic step with the modulus of its start misses
    const double size = 2.0 * std::max(stress_norm(at_), s_.p_min);
    const double elastic_error = a * std::abs(trial.p) / (2.0 * std::max(at_.p, s_.p_min)) * a *
                                 std::sqrt(2.0 * trial.p * trial.p + dot(trial.s, trial.s)) / size;
    if (a == 1.0) {
      next_ = from;
      return next_.p > 0.0 || forced ? elastic_error : 1.0;
    }
    const Strain rest{(1.0 - a) * step.volumetric, (1.0 - a) * step.deviator};
    const History h = history(c_, s_);
    const Rates r1 = rates(c_, s_, h, a > 0.0 ? local(c_, s_, Dr, from) : start, from, rest);
    const Point middle = moved(from, r1);
    if (!(middle.p > 0.0)) return collapse(from, forced);
    const Local at_middle = local(c_, s_, Dr, middle);
    const Rates r2 = rates(c_, s_, h, at_middle, middle, rest);
    next_ = {from.p + 0.5 * (r1.p + r2.p), from.s + 0.5 * (r1.s + r2.s),
             from.alpha + 0.5 * (r1.alpha + r2.alpha), from.z + 0.5 * (r1.z + r2.z)};
    if (!(next_.p > 0.0)) return collapse(from, forced);
    Mb_ = at_middle.surfaces.Mb;
    const Deviator ds = r2.s - r1.s;
    const double dp = r2.p - r1.p;
    return elastic_error + std::sqrt(2.0 * dp * dp + dot(ds, ds)) / size;
  }

  /// Mean stress would become tensile: a smaller step, or, where that is spent, the floor.
  double collapse(const Point& from, bool forced) {
    next_ = from;
    if (forced) next_.p = 0.0;
    return 1.0;
  }

  static double stress_norm(const Point& x) { return std::sqrt(2.0 * x.p * x.p + dot(x.s, x.s)); }

  void accept() {
    if (next_.p < 0.2 * s_.p_min) {
      next_.p = 0.2 * s_.p_min;
      ++floored;
    }
    // drift: the back-stress ratio is moved so that the stress lies on the yield surface
    const Deviator offset = next_.s - next_.p * next_.alpha;
    const double radius = kRootHalf * c_.m * next_.p, length = norm(offset);
    if (length > radius) next_.alpha = (1.0 / next_.p) * (next_.s - (radius / length) * offset);
    const double M_cur = kRoot2 * norm(next_.s) / std::max(next_.p, s_.p_min);
    if (M_cur > Mb_) {
      next_.s = (Mb_ / M_cur) * next_.s;
      next_.alpha = ((Mb_ - c_.m) / (Mb_ * next_.p)) * next_.s;
    }
    const Deviator dz = next_.z - at_.z;
    s_.z_cum += kRootHalf * norm(dz);
    s_.z_peak = std::max(s_.z_peak, kRootHalf * norm(next_.z));
    s_.alpha = next_.alpha;
    s_.z = next_.z;
    at_ = next_;
  }

  const Constants& c_;
  State s_;
  Point at_, next_{};
  double Mb_ = 0.0;
};

}  // namespace
}  // namespace pm4sand

PM4Sand::Update PM4Sand::update(const Constants& c, const State& old, const Stress<2>& sigma,
                                const StrainIncrement<2>& de) noexcept {
  using pm4sand::operator+, pm4sand::operator-;
  const double size = std::max({std::abs(de[0]), std::abs(de[1]), std::abs(de[3])});
  const pm4sand::Strain whole{-(de[0] + de[1]), {-0.5 * (de[0] - de[1]), -0.5 * de[3]}};
  const pm4sand::Point start{-0.5 * (sigma[0] + sigma[1]) - old.held_p,
                             Deviator{-0.5 * (sigma[0] - sigma[1]), -sigma[3]} - old.held,
                             old.alpha, old.z};
  Update r;
  const double all = start.p + start.s.d + start.s.t + de[0] + de[1] + de[3];
  if (!std::isfinite(all)) {
    r.stress.v.fill(kUnset);
    r.state = old;
    return r;
  }
  if (size == 0.0) return {sigma, old};
  pm4sand::Integration run(c, old, start);
  run.run(whole, size);
  const double p = run.point().p + old.held_p;
  const Deviator s = run.point().s + old.held;
  r.stress = {{-(p + s.d), -(p - s.d), -p, -s.t}};
  r.state = run.state();
  r.sub_steps = run.sub_steps;
  r.rejected = run.rejected;
  r.floored = run.floored;
  return r;
}

}  // namespace flowslide
