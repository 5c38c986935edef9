#pragma once
#include "verify/mpm/trial.hpp"

/// A strip that repeats itself along x, for infinite slopes and sheet flow: three copies stand side
/// by side, and after every step the outer two are made copies of the middle one again. What their
/// free sides do reaches two cells in a step, so that the middle copy never sees it.
namespace flowslide::mpm {

class PeriodicStrip {
 public:
  /// `particles` fill x in [0, period); period is a whole number of cells, at least three.
  PeriodicStrip(const ParticleSet& particles, double period, const FlowConfig& config);
  void step();
  void run_to(double time);
  /// Calls f(q) for the points of the middle copy.
  template <class F>
  void for_each(F&& f) const {
    for (std::size_t j = 0; j < count_; ++j) f(where_[j]);
  }
  Trial trial;

 private:
  void copy();
  double period_;
  std::size_t count_;
  std::vector<std::size_t> where_;  ///< storage of each point by its index
};

}  // namespace flowslide::mpm
