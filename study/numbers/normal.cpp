#include "study/numbers/normal.hpp"

#include "core/elementary.hpp"

#include <array>
#include <cmath>
#include <cstddef>

namespace flowslide::study {
namespace {

/// Coefficients from the highest power down.
template <std::size_t N>
double polynomial(const std::array<double, N>& c, double x) {
  double sum = c[0];
  for (std::size_t i = 1; i < N; ++i) sum = sum * x + c[i];
  return sum;
}

constexpr std::array<double, 7> kHartTop{3.52624965998911e-2, 0.700383064443688, 6.37396220353165,
                                         33.912866078383,     112.079291497871,  221.213596169931,
                                         220.206867912376};
constexpr std::array<double, 8> kHartBottom{8.83883476483184e-2, 1.75566716318264, 16.064177579207,
                                            86.7807322029461,    296.564248779674, 637.333633378831,
                                            793.826512519948,    440.413735824752};

constexpr std::array<double, 8> kCentreTop{
    2.5090809287301226727e3, 3.3430575583588128105e4, 6.7265770927008700853e4,
    4.5921953931549871457e4, 1.3731693765509461125e4, 1.9715909503065514427e3,
    1.3314166789178437745e2, 3.3871328727963666080};
constexpr std::array<double, 8> kCentreBottom{
    5.2264952788528545610e3, 2.8729085735721942674e4, 3.9307895800092710610e4,
    2.1213794301586595867e4, 5.3941960214247511077e3, 6.8718700749205790830e2,
    4.2313330701600911252e1, 1.0};
constexpr std::array<double, 8> kMiddleTop{
    7.74545014278341407640e-4, 2.27238449892691845833e-2, 2.41780725177450611770e-1,
    1.27045825245236838258,    3.64784832476320460504,    5.76949722146069140550,
    4.63033784615654529590,    1.42343711074968357734};
constexpr std::array<double, 8> kMiddleBottom{
    1.05075007164441684324e-9, 5.47593808499534494600e-4, 1.51986665636164571966e-2,
    1.48103976427480074590e-1, 6.89767334985100004550e-1, 1.67638483018380384940,
    2.05319162663775882187,    1.0};
constexpr std::array<double, 8> kTailTop{
    2.01033439929228813265e-7, 2.71155556874348757815e-5, 1.24266094738807843860e-3,
    2.65321895265761230930e-2, 2.96560571828504891230e-1, 1.78482653991729133580,
    5.46378491116411436990,    6.65790464350110377720};
constexpr std::array<double, 8> kTailBottom{
    2.04426310338993978564e-15, 1.42151175831644588870e-7, 1.84631831751005468180e-5,
    7.86869131145613259100e-4,  1.48753612908506148525e-2, 1.36929880922735805310e-1,
    5.99832206555887937690e-1,  1.0};

}  // namespace

double normal_probability(double x) {
  const double z = std::abs(x);
  if (z > 37.0) return x > 0.0 ? 1.0 : 0.0;
  const double bell = flowslide::exp(-0.5 * z * z);
  double tail = 0.0;
  if (z < 7.07106781186547) {
    tail = bell * polynomial(kHartTop, z) / polynomial(kHartBottom, z);
  } else {
    constexpr double kRootOfTwoPi = 2.506628274631;
    tail = bell / ((z + 1.0 / (z + 2.0 / (z + 3.0 / (z + 4.0 / (z + 0.65))))) * kRootOfTwoPi);
  }
  return x > 0.0 ? 1.0 - tail : tail;
}

double normal_quantile(double p) {
  const double q = p - 0.5;
  if (std::abs(q) <= 0.425) {
    const double r = 0.180625 - q * q;
    return q * polynomial(kCentreTop, r) / polynomial(kCentreBottom, r);
  }
  const double r = std::sqrt(-flowslide::log(q < 0.0 ? p : 1.0 - p));
  const double z = r <= 5.0
                       ? polynomial(kMiddleTop, r - 1.6) / polynomial(kMiddleBottom, r - 1.6)
                       : polynomial(kTailTop, r - 5.0) / polynomial(kTailBottom, r - 5.0);
  return q < 0.0 ? -z : z;
}

}  // namespace flowslide::study
