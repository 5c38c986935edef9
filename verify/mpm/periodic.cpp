#include "verify/mpm/periodic.hpp"

#include <cmath>

namespace flowslide::mpm {
namespace {

/// The particles themselves, then their copies at -period and +period.
ParticleSet three_copies(const ParticleSet& p, double period) {
  ParticleSet all = p;
  const std::size_t n = p.size();
  resize(all, 3 * n);
  for (std::size_t j = 0; j < n; ++j) {
    for (const std::size_t k : {1, 2}) {
      const std::size_t q = k * n + j;
      all.position[q] = p.position[j];
      all.position[q][0] += k == 1 ? -period : period;
      all.velocity[q] = p.velocity[j];
      all.stress[q] = p.stress[j];
      all.mass[q] = p.mass[j];
      all.volume[q] = p.volume[j];
      all.pore_pressure[q] = p.pore_pressure[j];
      all.material[q] = p.material[j];
      all.id[q] = static_cast<std::int64_t>(q) + 1;
    }
  }
  return all;
}

}  // namespace

PeriodicStrip::PeriodicStrip(const ParticleSet& particles, double period, const FlowConfig& config)
    : trial(three_copies(particles, period), config),
      period_(period),
      count_(particles.size()),
      where_(3 * count_) {
  copy();
}

void PeriodicStrip::copy() {
  Points<2>& p = trial.sim.points;
  for (std::size_t q = 0; q < p.size(); ++q) where_[static_cast<std::size_t>(p.index[q])] = q;
  bool wrapped = false;
  for (std::size_t j = 0; j < count_; ++j) {
    const std::size_t own = where_[j], left = where_[count_ + j], right = where_[2 * count_ + j];
    const double turns = std::floor(p.x[0][own] / period_);
    if (turns != 0.0) {
      p.x[0][own] -= turns * period_;
      wrapped = true;
    }
    visit_arrays(p, [&](auto& array) {
      if constexpr (std::is_same_v<std::decay_t<decltype(array)>, StaggeredArray<double>>)
        array[left] = array[right] = array[own];
    });
    p.x[0][left] -= period_;
    p.x[0][right] += period_;
  }
  if (wrapped) {
    trial.rebin();
    for (std::size_t q = 0; q < p.size(); ++q) where_[static_cast<std::size_t>(p.index[q])] = q;
  }
}

void PeriodicStrip::step() {
  trial.step();
  copy();
}

void PeriodicStrip::run_to(double time) {
  while (trial.sim.time < time) step();
}

}  // namespace flowslide::mpm
