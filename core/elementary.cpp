#include "core/elementary.hpp"

#include "core/elementary_lanes.hpp"

#include <cmath>

namespace flowslide {
namespace {

using namespace elementary;
using Two = TwoParts;

/// a + b exactly (Knuth).
constexpr Two sum(double a, double b) {
  const double s = a + b, of_b = s - a;
  return {s, (a - (s - of_b)) + (b - of_b)};
}
/// The same for |a| >= |b| (Dekker).
constexpr Two quick_sum(double a, double b) {
  const double s = a + b;
  return {s, b - (s - a)};
}
/// a b exactly (Dekker), below 1e290.
constexpr Two product(double a, double b) {
  constexpr double kSplit = 0x1p27 + 1.0;
  const double wide_a = kSplit * a, wide_b = kSplit * b;
  const double a1 = wide_a - (wide_a - a), a2 = a - a1;
  const double b1 = wide_b - (wide_b - b), b2 = b - b1;
  const double p = a * b;
  return {p, ((a1 * b1 - p) + a1 * b2 + a2 * b1) + a2 * b2};
}

/// 2^n for -1022 <= n <= 1023.
double power_of_two(int n) {
  return std::bit_cast<double>(static_cast<std::uint64_t>(n + 1023) << 52);
}

/// log(x) to 100 bits or more, for 0 < x < infinity.
Two log_in_two(double x) noexcept {
  const auto [m, n] = parts(x);
  // log m = 2 (s + s^3/3 + s^5/5 + ...), s = (m - 1)/(m + 1), |s| < 0.172
  const double f = m - 1.0;
  const Two below = quick_sum(2.0, f);
  const double s = f / below.high;
  const Two back = product(s, below.high);
  const double s_low = (((f - back.high) - back.low) - s * below.low) / below.high;
  Two z = product(s, s);
  z.low += 2.0 * s * s_low;
  Two cube = product(s, z.high);
  cube.low += s * z.low + s_low * z.high;
  constexpr double kTwoThirds = 2.0 / 3, kTwoThirdsLow = 0x1.5555555555555p-55;
  Two third = product(kTwoThirds, cube.high);
  third.low += kTwoThirds * cube.low + kTwoThirdsLow * cube.high;
  const double z1 = z.high, z2 = z1 * z1, z4 = z2 * z2;
  const double series = ((2.0 / 5 + z1 * (2.0 / 7)) + z2 * (2.0 / 9 + z1 * (2.0 / 11))) +
                        z4 * ((2.0 / 13 + z1 * (2.0 / 15)) + z2 * (2.0 / 17 + z1 * (2.0 / 19)) +
                              z4 * (2.0 / 21 + z1 * (2.0 / 23)));
  const Two first = sum(n * kLn2High, 2.0 * s), second = sum(first.high, third.high);
  return sum(second.high, (first.low + second.low) + (n * kLn2Low + 2.0 * s_low + third.low) +
                              cube.high * z1 * series);
}

/// Power of two that keeps squares and products of numbers up to `most` within range.
double scale_of(double most) {
  if (most > 0x1p500) return 0x1p-600;
  return most < 0x1p-400 ? 0x1p600 : 1.0;
}

/// Angle less a multiple of pi/2, between -pi/4 and pi/4; `quadrant` counts the multiples.
struct Reduced {
  Two angle;
  std::int64_t quadrant;
};
Reduced reduced(double x) noexcept {
  constexpr double kQuarter = 0.785398163397448, kTwoOverPi = 0x1.45f306dc9c883p-1;
  constexpr double kRound = 0x1.8p52;
  if (std::abs(x) <= kQuarter) return {{x, 0.0}, 0};
  // pi/2 in parts of 24 bits, whose products with n < 2^29 are exact
  constexpr double kFirst = 0x1.921fb4p+0, kSecond = 0x1.4442dp-24, kThird = 0x1.846988p-48,
                   kRest = 0x1.8cc51701b839ap-72;
  const double n = (x * kTwoOverPi + kRound) - kRound;
  const double near = (x - n * kFirst) - n * kSecond;
  const Two third = sum(near, -n * kThird);
  const Two angle = sum(third.high, third.low - n * kRest);
  return {angle, static_cast<std::int64_t>(n)};
}

double sin_near_zero(Two angle) {
  const double r = angle.high, z = r * r, z2 = z * z;
  const double series =
      (1.0 / 120 - z * (1.0 / 5040)) +
      z2 * ((1.0 / 362880 - z * (1.0 / 39916800)) +
            z2 * ((1.0 / 6227020800 - z * (1.0 / 1307674368000)) + z2 * (1.0 / 355687428096000)));
  const double cube = z * r;
  return r - ((z * (0.5 * angle.low - cube * series) - angle.low) + cube * (1.0 / 6));
}
double cos_near_zero(Two angle) {
  const double r = angle.high, z = r * r, z2 = z * z;
  const double series =
      (1.0 / 24 - z * (1.0 / 720)) +
      z2 * ((1.0 / 40320 - z * (1.0 / 3628800)) +
            z2 * ((1.0 / 479001600 - z * (1.0 / 87178291200)) + z2 * (1.0 / 20922789888000)));
  const double half = 0.5 * z, w = 1.0 - half;
  return w + (((1.0 - w) - half) + (z2 * series - r * angle.low));
}

/// sin of the angle and `further` right angles.
double sin_of(double x, std::int64_t further) {
  constexpr double kFarthest = 5e8;
  if (!(std::abs(x) <= kFarthest)) return kNan;
  const Reduced r = reduced(x);
  const std::int64_t quadrant = (r.quadrant + further) & 3;
  const double y = quadrant % 2 == 0 ? sin_near_zero(r.angle) : cos_near_zero(r.angle);
  return quadrant < 2 ? y : -y;
}

/// atan(n/d) for 0 <= n <= d, d > 0, in two parts: the nearest eighth, and a series for the rest.
Two atan_of_ratio(double n, double d) {
  constexpr std::array<Two, 9> kEighths{{{0.0, 0.0},
                                         {0x1.fd5ba9aac2f6ep-4, -0x1.cd37686760c17p-59},
                                         {0x1.f5b75f92c80ddp-3, 0x1.8ab6e3cf7afbdp-57},
                                         {0x1.6f61941e4def1p-2, -0x1.c63aae6f6e918p-56},
                                         {0x1.dac670561bb4fp-2, 0x1.a2b7f222f65e2p-56},
                                         {0x1.1e00babdefeb4p-1, -0x1.928df287a668fp-58},
                                         {0x1.4978fa3269ee1p-1, 0x1.2419a87f2a458p-56},
                                         {0x1.700a7c5784634p-1, -0x1.8c34d25aadef6p-56},
                                         {0x1.921fb54442d18p-1, 0x1.1a62633145c07p-55}}};
  const auto i = static_cast<std::size_t>(8.0 * (n / d) + 0.5);
  const double c = 0.125 * static_cast<double>(i);
  const Two cd = product(c, d);
  const double t = ((n - cd.high) - cd.low) / (d + c * n), z = t * t;
  const double series =
      z * (-1.0 / 3 + z * (1.0 / 5 + z * (-1.0 / 7 + z * (1.0 / 9 + z * (-1.0 / 11 + z / 13)))));
  const Two whole = sum(kEighths[i].high, t);
  return quick_sum(whole.high, whole.low + (t * series + kEighths[i].low));
}

}  // namespace

namespace elementary {

// By the exponential series and exact sums at compile time.
constinit const std::array<TwoParts, kSteps> kRoots = [] {
  std::array<Two, kSteps> roots{};
  for (int i = 0; i < kSteps; ++i) {
    const double share = static_cast<double>(i) / kSteps;
    const Two x = quick_sum(share * kLn2High, share * kLn2Low);  // exact products
    Two term{1.0, 0.0}, total{1.0, 0.0};
    for (int k = 1; k < 30; ++k) {
      Two next = product(term.high, x.high);
      next.low += term.high * x.low + term.low * x.high;
      const double quotient = next.high / k;
      const Two back = product(quotient, k);
      term = quick_sum(quotient, (((next.high - back.high) - back.low) + next.low) / k);
      const Two s = sum(total.high, term.high);
      total = quick_sum(s.high, s.low + total.low + term.low);
    }
    roots[static_cast<std::size_t>(i)] = total;
  }
  return roots;
}();

double exp_far(double x, double c) noexcept {
  constexpr double kHighest = 709.79, kLowest = -745.2;
  if (x > kHighest) return kInfinity;
  if (x < kLowest) return 0.0;
  if (std::isnan(x)) return x;
  const Scaled<double> s = scaled_exp(x, c);
  const int exponent = static_cast<int>(static_cast<std::int64_t>(s.n << 13) >> 13) / kSteps;
  const int half = exponent / 2;
  return s.m * power_of_two(half) * power_of_two(exponent - half);
}

}  // namespace elementary

double exp(double x) noexcept { return exp_of_sum(x, 0.0); }

double log(double x) noexcept {
  if (!(x > 0.0 && x < kInfinity)) return x == 0.0 ? -kInfinity : x > 0.0 ? x : kNan;
  return log_inside(x);
}

double pow(double x, double y) noexcept {
  if (y == 0.0 || x == 1.0) return 1.0;
  if (!(x >= 0.0)) return kNan;
  if (x == 0.0 || x == kInfinity)
    return std::isnan(y) ? y : (x == 0.0) == (y > 0.0) ? 0.0 : kInfinity;
  const Two l = log_in_two(x);
  const double most = y * l.high;
  if (!(std::abs(most) < 750.0)) return std::isnan(y) ? y : most > 0.0 ? kInfinity : 0.0;
  const Two exponent = product(y, l.high);
  return exp_of_sum(exponent.high, exponent.low + y * l.low);
}

double pow(double x, int n) noexcept {
  double result = 1.0;
  for (int i = 0; i < std::abs(n); ++i) result *= x;
  return n < 0 ? 1.0 / result : result;
}

double sin(double x) noexcept { return sin_of(x, 0); }
double cos(double x) noexcept { return sin_of(x, 1); }
double tan(double x) noexcept { return sin(x) / cos(x); }
double asin(double x) noexcept {
  if (!(std::abs(x) <= 1.0)) return kNan;
  return atan2(x, std::sqrt((1.0 - x) * (1.0 + x)));
}

double atan2(double y, double x) noexcept {
  double n = std::abs(y), d = std::abs(x);
  if (!(n < kInfinity && d < kInfinity)) return kNan;
  constexpr Two kRight{0x1.921fb54442d18p+0, 0x1.1a62633145c07p-54};
  if (n == 0.0) return std::copysign(std::signbit(x) ? 2.0 * kRight.high : 0.0, y);
  const bool steep = n > d;
  const double scale = scale_of(steep ? n : d);
  n *= scale, d *= scale;
  Two a = steep ? atan_of_ratio(d, n) : atan_of_ratio(n, d);
  // From the axis in use to the positive x-axis, in multiples of a right angle.
  const double turn = steep ? 1.0 : std::signbit(x) ? 2.0 : 0.0;
  const double sign = steep != std::signbit(x) ? -1.0 : 1.0;
  if (turn > 0.0) {
    const Two whole = sum(turn * kRight.high, sign * a.high);
    a = {whole.high, whole.low + (turn * kRight.low + sign * a.low)};
  }
  return std::copysign(a.high + a.low, y);
}

double hypot(double x, double y) noexcept {
  const double most = std::abs(x) > std::abs(y) ? std::abs(x) : std::abs(y);
  const double scale = scale_of(most);
  x *= scale, y *= scale;
  return std::sqrt(x * x + y * y) / scale;
}

}  // namespace flowslide
