#include "section/limit_equilibrium.hpp"

#include "core/check.hpp"
#include "core/elementary.hpp"

#include <algorithm>
#include <cmath>

namespace flowslide {
namespace {

/// Below this share of its normal value the denominator of a slice makes its force meaningless.
constexpr double kLeastDenominator = 0.1;
constexpr int kMostIterations = 200;

double driving(const std::vector<Slice>& slices) {
  double sum = 0.0;
  for (const Slice& s : slices) sum += s.weight * sin(s.angle);
  return sum;
}

/// Shear strength of the base without what the forces between slices add [N/m].
double own_resistance(const Slice& s) {
  const double length = s.width / cos(s.angle);
  return s.cohesion * length +
         (s.weight * cos(s.angle) - s.pore_pressure * length) * s.tan_friction;
}

/// What the balance at one inclination needs of each slice:
///   Q = (resistance / F - drive) / (along + across / F).
struct Term {
  double resistance, drive, along, across;
  double arm;  ///< of a force of that inclination about the origin
};

std::vector<Term> terms_of(const std::vector<Slice>& slices, double inclination) {
  std::vector<Term> terms;
  terms.reserve(slices.size());
  const double sine = sin(inclination), cosine = cos(inclination);
  for (const Slice& s : slices) {
    const double turn = s.angle - inclination;
    terms.push_back({own_resistance(s), s.weight * sin(s.angle), cos(turn),
                     sin(turn) * s.tan_friction, s.base[0] * sine + s.base[1] * cosine});
  }
  return terms;
}

/// Sums of the forces between slices; not admissible where a denominator is too small.
struct Residual {
  double force = 0.0, moment = 0.0;
  bool admissible = true;
};

Residual residual(const std::vector<Term>& terms, double inverse_factor) {
  Residual r;
  for (const Term& t : terms) {
    const double denominator = t.along + t.across * inverse_factor;
    r.admissible = r.admissible && denominator > kLeastDenominator;
    const double q = (t.resistance * inverse_factor - t.drive) / denominator;
    r.force += q;
    r.moment += q * t.arm;
  }
  return r;
}

/// 1/F for which the forces balance: false position with the retained end's value halved
/// (Illinois).
std::optional<double> force_balance(const std::vector<Term>& terms) {
  double low = 1.0 / 50.0, high = 1.0;
  Residual at_low = residual(terms, low), at_high = residual(terms, high);
  if (!at_low.admissible || !(at_low.force < 0.0)) return std::nullopt;
  while (at_high.admissible && !(at_high.force > 0.0)) {
    low = high;
    at_low = at_high;
    high *= 2.0;
    if (high > 200.0) return std::nullopt;
    at_high = residual(terms, high);
  }
  // Large 1/F make bases that rise outwards inadmissible: the bracket ends before.
  for (int i = 0; i < kMostIterations && !at_high.admissible; ++i) {
    const double middle = 0.5 * (low + high);
    const Residual r = residual(terms, middle);
    if (r.admissible && !(r.force > 0.0)) {
      low = middle;
      at_low = r;
    } else {
      high = middle;
      at_high = r;
    }
    if (high - low < 1e-6 * high && !at_high.admissible) return std::nullopt;
  }
  double f_low = at_low.force, f_high = at_high.force;
  for (int i = 0; i < kMostIterations && high - low > 1e-11 * high; ++i) {
    const double at = (low * f_high - high * f_low) / (f_high - f_low);
    const Residual r = residual(terms, at);
    if (!r.admissible) return std::nullopt;
    if (r.force == 0.0) return at;
    if (r.force < 0.0) {
      if (at - low < 1e-12 * high) return at;
      low = at;
      f_low = r.force;
      f_high *= 0.5;
    } else {
      if (high - at < 1e-12 * high) return at;
      high = at;
      f_high = r.force;
      f_low *= 0.5;
    }
  }
  return 0.5 * (low + high);
}

}  // namespace

std::vector<Slice> cut_slices(const SlopeModel& model, const std::vector<Vec2>& surface,
                              double width) {
  std::vector<Slice> slices;
  for (std::size_t leg = 1; leg < surface.size(); ++leg) {
    const Vec2 a = surface[leg - 1], b = surface[leg];
    if (!(b[0] > a[0])) return {};
    const int n = std::max(1, static_cast<int>(std::ceil((b[0] - a[0]) / width - 1e-9)));
    for (int i = 0; i < n; ++i) {
      const double t = (i + 0.5) / n;
      Slice s;
      s.base = {a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])};
      s.width = (b[0] - a[0]) / n;
      s.angle = atan2(a[1] - b[1], b[0] - a[0]);
      const Column column = column_above(model, s.base);
      if (!column.inside) return {};
      s.weight = column.weight * s.width;
      s.pore_pressure = column.pore_pressure;
      s.cohesion = column.cohesion;
      s.tan_friction = column.tan_friction;
      slices.push_back(s);
    }
  }
  return slices;
}

std::vector<Vec2> arc(Vec2 centre, double radius, double x_left, double x_right, int legs) {
  const auto angle_at = [&](double x) {
    return asin(std::clamp((x - centre[0]) / radius, -1.0, 1.0));
  };
  const double from = angle_at(x_left), to = angle_at(x_right);
  std::vector<Vec2> points;
  for (int i = 0; i <= legs; ++i) {
    const double angle = from + (to - from) * i / legs;
    points.push_back({centre[0] + radius * sin(angle), centre[1] - radius * cos(angle)});
  }
  return points;
}

std::optional<double> ordinary(const std::vector<Slice>& slices) {
  const double drive = driving(slices);
  if (slices.empty() || !(drive > 0.0)) return std::nullopt;
  double resist = 0.0;
  for (const Slice& s : slices) resist += own_resistance(s);
  return resist / drive;
}

std::optional<double> bishop(const std::vector<Slice>& slices) {
  const double drive = driving(slices);
  if (slices.empty() || !(drive > 0.0)) return std::nullopt;
  double factor = std::max(ordinary(slices).value_or(1.0), 0.05);
  for (int i = 0; i < kMostIterations; ++i) {
    double resist = 0.0;
    for (const Slice& s : slices) {
      const double m = cos(s.angle) + sin(s.angle) * s.tan_friction / factor;
      if (!(m > kLeastDenominator)) return std::nullopt;
      resist +=
          (s.cohesion * s.width + (s.weight - s.pore_pressure * s.width) * s.tan_friction) / m;
    }
    const double next = resist / drive;
    if (!(next > 0.0) || !std::isfinite(next)) return std::nullopt;
    if (std::abs(next - factor) < 1e-10 * factor) return next;
    factor = next;
  }
  return std::nullopt;
}

namespace {

/// Balance of forces at an inclination, with the moment that is left.
struct Balance {
  double inclination, moment, factor;
};

}  // namespace

std::optional<SpencerResult> spencer(const std::vector<Slice>& slices) {
  if (slices.empty() || !(driving(slices) > 0.0)) return std::nullopt;
  // The moment is taken about the middle of the bases, so that its sign does not drown in q y.
  std::vector<Slice> centred = slices;
  Vec2 middle{};
  for (const Slice& s : slices)
    for (std::size_t k = 0; k < 2; ++k) middle[k] += s.base[k] / static_cast<double>(slices.size());
  for (Slice& s : centred)
    for (std::size_t k = 0; k < 2; ++k) s.base[k] -= middle[k];
  const auto balance_at = [&centred](double inclination) -> std::optional<Balance> {
    const std::vector<Term> terms = terms_of(centred, inclination);
    const auto inverse = force_balance(terms);
    if (!inverse) return std::nullopt;
    return Balance{inclination, residual(terms, *inverse).moment, 1.0 / *inverse};
  };
  // A scan for a change of sign of the moment, then bisection.
  constexpr double kFrom = -0.1, kTo = 0.8;
  constexpr int kScan = 9;
  std::optional<Balance> last;
  for (int i = 0; i <= kScan; ++i) {
    const std::optional<Balance> now = balance_at(kFrom + (kTo - kFrom) * i / kScan);
    if (now && last && (now->moment > 0.0) != (last->moment > 0.0)) {
      Balance low = *last, high = *now;
      while (high.inclination - low.inclination > 1e-7) {
        const auto middle_balance = balance_at(0.5 * (low.inclination + high.inclination));
        if (!middle_balance) return std::nullopt;
        ((middle_balance->moment > 0.0) == (high.moment > 0.0) ? high : low) = *middle_balance;
      }
      return SpencerResult{high.factor, high.inclination};
    }
    last = now;
  }
  return std::nullopt;
}

}  // namespace flowslide
