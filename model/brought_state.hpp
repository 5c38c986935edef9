#pragma once
#include "model/particle_set.hpp"

#include <string_view>

namespace flowslide {

/// A state variable of the points' laws as the points bring it; where they bring none, the material
/// has a value for all. The one rule for the transfer, which asks what a law can carry, and for the
/// runout, which starts from it.
class BroughtState {
 public:
  /// History variables are what a law calls by that name; the pore pressure has a field besides,
  /// which counts where there is no history of it.
  BroughtState(const ParticleSet& p, std::string_view name) : is_strength_(is_strength(name)) {
    if (const auto found = p.history.find(std::string(name)); found != p.history.end())
      values_ = &found->second;
    else if (name == "pore_pressure")
      values_ = &p.pore_pressure;
  }
  /// The transfer gives a strength to what has liquefied and 0 to other points: that is none.
  [[nodiscard]] double at(std::size_t point, double of_material) const {
    if (!values_) return of_material;
    const double value = (*values_)[point];
    return is_strength_ && value == 0.0 ? of_material : value;
  }

 private:
  static bool is_strength(std::string_view name) {
    return name == "strength" || name == "soft_strength";
  }
  const std::vector<double>* values_ = nullptr;
  bool is_strength_;
};

}  // namespace flowslide
