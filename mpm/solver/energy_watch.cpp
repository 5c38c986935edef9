#include "mpm/solver/energy_watch.hpp"

#include "core/check.hpp"

#include <algorithm>
#include <cmath>

namespace flowslide::mpm {
namespace {

/// Shares of what was brought in that stable runs stay far below: dissipation falls by up to 1 % of
/// it as elastic bodies bounce, and the stress power of a corotational law differs by up to 7 %
/// from what it stores.
constexpr double kMostMade = 0.2, kMostElastic = 0.5;

}  // namespace

void EnergyWatch::look(const MpmSample& now, bool elastic) {
  const double gravity = std::max(gravity_, std::abs(now.gravity_work));
  const double load = std::max(load_, std::abs(now.load_work));
  brought += gravity - gravity_ + load - load_;
  gravity_ = gravity;
  load_ = load;
  const double total = now.plastic_work + now.friction_work + now.damping_work;
  dissipated = std::max(dissipated, total);
  const double made = dissipated - total;
  const bool plastic = elastic && !(std::abs(now.plastic_work) <= kMostElastic * brought);
  if (made <= kMostMade * brought && !plastic) return;
  throw NumericsError(fmt::format(
      "t = {:.4f} s: {} where gravity, loads and the start brought {:.3g} J (the scheme is "
      "unstable: material work {:.3g} J, friction {:.3g} J, transfer {:.3g} J, fastest point {:.3g} "
      "m/s) take basis quadratic or cubic, a smaller courant, or another transfer or update",
      now.time,
      plastic ? fmt::format("elastic soil has done {:.3g} J of plastic work", now.plastic_work)
              : fmt::format("{:.3g} J of energy have come from nowhere", made),
      brought, now.plastic_work, now.friction_work, now.damping_work, now.max_speed));
}

}  // namespace flowslide::mpm
