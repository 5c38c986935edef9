#include "core/elementary.hpp"
#include "motion/butterworth.hpp"
#include "motion/measures.hpp"
#include "motion/process.hpp"
#include "motion/synthetic.hpp"
#include "tests/bits/digest.hpp"
#include "tests/bits/scenes.hpp"

namespace flowslide::same_bits {
namespace {

/// f(x, y) over numbers of all sizes that matter.
template <class F>
Line line(const std::string& name, F&& f) {
  Digest digest;
  std::uint64_t state = 1;
  const auto uniform = [&] {
    state = state * 6364136223846793005u + 1442695040888963407u;
    return (static_cast<double>(state >> 11) + 0.5) * 0x1p-53;
  };
  for (int i = 0; i < 20000; ++i) {
    const double size = std::ldexp(1.0, static_cast<int>(20.0 * uniform()) - 10);
    digest.add(f(size * uniform(), 4.0 * uniform() - 2.0));
  }
  return {"function/" + name, digest.text()};
}

}  // namespace

Lines functions() {
  return {line("exp", [](double x, double y) { return exp(x * y); }),
          line("log", [](double x, double) { return log(x); }),
          line("pow", [](double x, double y) { return pow(x, y); }),
          line("sin", [](double x, double y) { return sin(x * y); }),
          line("cos", [](double x, double y) { return cos(x * y); }),
          line("tan", [](double x, double y) { return tan(x * y); }),
          line("asin", [](double, double y) { return asin(0.5 * y); }),
          line("atan2", [](double x, double y) { return atan2(y, 2.0 - x); }),
          line("hypot", [](double x, double y) { return hypot(x, y); })};
}

Lines motions() {
  Lines lines;
  const auto add = [&](const std::string& name, const GroundMotion& m) {
    Digest digest;
    digest.add(m.acceleration);
    const MotionMeasures a = measure(m);
    for (const double x : {m.dt, a.pga, a.pgv, a.arias, a.d5_95, a.tm, a.cav, a.masi})
      digest.add(x);
    lines.push_back({"motion/" + name, digest.text()});
  };
  SyntheticConfig c;
  c.pga = 3.0;
  c.tm = 0.5;
  c.d5_95 = 4.0;
  const GroundMotion m = synthesize(c);
  add("synthetic", m);
  BandPass band;
  band.high_pass = 0.2;
  band.low_pass = 15.0;
  add("filtered", filtered(m, band));
  add("resampled", resampled(m, 0.7 * m.dt, ResampleMethod::band_limited));
  add("baseline", baseline_corrected(m, 3, BaselineFit::velocity));
  return lines;
}

}  // namespace flowslide::same_bits
