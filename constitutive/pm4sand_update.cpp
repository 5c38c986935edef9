#include "constitutive/pm4sand_lanes.hpp"

namespace flowslide {

PM4Sand::Update PM4Sand::update(const Constants& c, const State& old, const Stress<2>& sigma,
                                const StrainIncrement<2>& de) noexcept {
  Update r;
  r.stress = sigma;
  r.state = old;
  bool waiting = true;
  static_cast<Work&>(r) = pm4sand::integrate<double>([&](Task& task) {
    task = {&c, &r.state, &r.stress, de};
    return std::exchange(waiting, false);
  });
  return r;
}

}  // namespace flowslide
