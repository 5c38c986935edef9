#include "transfer/zone/transfer_time.hpp"

#include "core/check.hpp"

#include <algorithm>
#include <cmath>

namespace flowslide {
namespace {

/// Samples of a record that may be used: all before the first excessive distortion.
std::size_t undistorted_samples(const AutomaticTransfer& rule, const ZoneHistory& h) {
  const std::vector<double>& q =
      rule.jacobian == JacobianPoint::gauss ? h.distortion_gauss : h.distortion_centre;
  std::size_t n = 0;
  while (n < q.size() && q[n] >= rule.distortion_limit) ++n;
  return n;
}

struct Development {
  std::size_t sample = 0;
  std::string window;
  double depth = 0.0;
};

/// The window that takes longest to reach its share of its largest depth among `samples` samples.
Development full_development(const AutomaticTransfer& rule, const ZoneHistory& h,
                             std::size_t samples) {
  Development last;
  for (std::size_t w = 0; w < h.depth_max.size(); ++w) {
    const double deepest = h.depth_max[w][samples - 1];
    if (!(deepest > 0.0)) continue;
    std::size_t i = 0;
    while (h.depth_max[w][i] < rule.development * deepest) ++i;
    if (last.window.empty() || i > last.sample) last = {i, h.window_names[w], h.depth_max[w][i]};
  }
  return last;
}

std::size_t nearest_sample(std::span<const double> time, double t) {
  std::size_t best = 0;
  for (std::size_t i = 1; i < time.size(); ++i) {
    if (std::abs(time[i] - t) < std::abs(time[best] - t)) best = i;
  }
  return best;
}

TransferChoice at_sample(const ZoneHistory& h, std::size_t i, const std::string& reason) {
  return {static_cast<int>(i), h.time[i],
          fmt::format("{}; frame {} of {} at {:.4g} s", reason, i + 1, h.time.size(), h.time[i])};
}

TransferChoice automatic(const AutomaticTransfer& rule, const ZoneHistory& h,
                         const TransferEvidence& evidence) {
  const std::size_t n = h.time.size();
  const std::size_t usable = undistorted_samples(rule, h);
  const std::string_view point = kJacobianPoints[static_cast<std::size_t>(rule.jacobian)];
  validate(usable > 0,
           "the mesh distortion Q is below {} in the first frame already (there is no state to "
           "transfer) check displacements and strains, or choose the time with when: at",
           rule.distortion_limit);
  const std::string distorted = usable < n ? fmt::format("Q ({}) falls below {} at {:.4g} s", point,
                                                         rule.distortion_limit, h.time[usable])
                                           : std::string();
  const std::optional<EnergyOnset> onset = find_onset(rule, h, evidence);
  if (!onset || onset->grown >= usable) {
    const std::optional<EnergyOnset> rising = rising_at_end(rule, h, evidence);
    if (usable == n && rising) {
      return at_sample(
          h, n - 1,
          fmt::format(
              "the kinetic energy exceeds {:g} times its pre-failure envelope from {:.4g} s "
              "to the end of the record, too short a time to call it failure, so the end of "
              "the record is taken",
              rule.growth, h.time[rising->grown]));
    }
    if (usable == n) {
      return at_sample(h, n - 1, fmt::format("{}, so the end of the record is taken", kNoFailure));
    }
    return at_sample(
        h, usable - 1,
        fmt::format("{} before the kinetic energy outgrows its pre-failure envelope, so the "
                    "last frame before the distortion is taken",
                    distorted));
  }
  const Development full = full_development(rule, h, usable);
  const std::string developed =
      full.window.empty() ? "no window has liquefied"
                          : fmt::format("liquefaction is fully developed at {:.4g} s ({} {:.3g} m)",
                                        h.time[full.sample], full.window, full.depth);
  const std::size_t begin = std::max(onset->grown, full.sample);
  const std::string failure = fmt::format(
      "the {} kinetic energy leaves its pre-failure envelope at {:.4g} s and exceeds {:g} times it "
      "from {:.4g} s on ({:.3g} J/m against {:.3g} J/m), {}",
      kEnergyFrames[static_cast<std::size_t>(rule.energy)], h.time[onset->begin], rule.growth,
      h.time[onset->grown], onset->energy, onset->envelope, developed);
  if (usable == n) {
    return at_sample(
        h, n - 1,
        fmt::format("{}, and the record ends before Q ({}) falls below {}, so its last "
                    "frame is taken",
                    failure, point, rule.distortion_limit));
  }
  const double target = h.time[begin] + rule.between * (h.time[usable] - h.time[begin]);
  const std::span<const double> times(h.time.data(), usable);
  return at_sample(
      h, nearest_sample(times, target),
      fmt::format("{}, {}, and {:g} of the way from the later of growth and development to "
                  "the distortion is {:.4g} s",
                  failure, distorted, rule.between, target));
}

}  // namespace

void check(const TransferTimeConfig& c) {
  if (c.when == TransferWhen::at) {
    validate(c.at && std::isfinite(*c.at),
             "when: at without a time (the transfer time is unknown) add e.g. at: 7.01 s");
  } else {
    validate(!c.at,
             "at: {} s with when: {} (only one of them can hold) write when: at, or remove at",
             c.at.value_or(0.0), kTransferWhens[static_cast<std::size_t>(c.when)]);
  }
}

TransferChoice choose_transfer(const TransferTimeConfig& config, const ZoneHistory& h,
                               const TransferEvidence& evidence) {
  if (config.when == TransferWhen::gravity) {
    return {-1, 0.0, "the gravity state is transferred, as asked for"};
  }
  validate(!h.time.empty(),
           "the history holds the gravity state only (when: {} needs recorded frames) write when: "
           "gravity, or import the shaking",
           kTransferWhens[static_cast<std::size_t>(config.when)]);
  if (config.when == TransferWhen::end) {
    return at_sample(h, h.time.size() - 1, "the end of the record, as asked for");
  }
  if (config.when == TransferWhen::at) {
    const double t = config.at.value();
    validate(
        t >= h.time.front() && t <= h.time.back(),
        "transfer time {} s is outside the record (nothing is extrapolated) choose a time from "
        "{} s to {} s, or when: gravity",
        t, h.time.front(), h.time.back());
    return at_sample(h, nearest_sample(h.time, t), fmt::format("{} s, as asked for", t));
  }
  return automatic(config.automatic, h, evidence);
}

bool is_settled(const TransferTimeConfig& config, const ZoneHistory& h,
                const TransferEvidence& evidence) {
  if (config.when == TransferWhen::gravity) return true;
  if (config.when == TransferWhen::end || h.time.empty()) return false;
  if (config.when == TransferWhen::at) return h.time.back() >= config.at.value();
  const AutomaticTransfer& rule = config.automatic;
  const std::size_t usable = undistorted_samples(rule, h);
  if (usable == h.time.size()) return false;
  if (find_onset(rule, h, evidence)) return true;
  return h.time[usable] + rule.smoothing + rule.sustain <= h.time.back();
}

void Schema<AutomaticTransfer>::describe(FieldVisitor& v, AutomaticTransfer& c) {
  v.choice("energy", c.energy, kEnergyFrames,
           "sliding: kinetic energy of the velocity relative to the base, averaged over "
           "`smoothing`; relative and absolute: trailing mean of the energy of the velocity of the "
           "moment, against the base or not");
  v.quantity("smoothing", c.smoothing, Dim::time, {.min = 0.0},
             "length of the trailing mean of the velocity or the kinetic energy");
  v.quantity("growth", c.growth, Dim::none, {.min = 1.0},
             "onset of failure: the energy exceeds this multiple of its pre-failure envelope");
  v.quantity("sustain", c.sustain, Dim::time, {.min = 0.0},
             "onset of failure: how long beyond the smoothing it stays above, ending higher than "
             "it began");
  v.quantity("development", c.development, Dim::none, {.min = 0.01, .max = 1.0},
             "liquefaction is fully developed at this share of the largest depth in every window");
  v.quantity("strain_threshold", c.strain_threshold, Dim::none, {.min = 0.0},
             "deviatoric strain eps_q from which an element counts in the distortion Q");
  v.quantity("distortion_limit", c.distortion_limit, Dim::none, {.min = 0.01, .max = 1.0},
             "the mesh is excessively distorted when Q falls below");
  v.choice("jacobian", c.jacobian, kJacobianPoints,
           "Q from the smallest Jacobian ratio of the 2x2 Gauss points, or from the centre");
  v.quantity(
      "between", c.between, Dim::none, {.min = 0.0, .max = 1.0},
      "where the transfer lies from full failure development (0) to excessive distortion (1)");
}

}  // namespace flowslide
