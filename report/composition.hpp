#pragma once
#include "core/check.hpp"
#include "model/front.hpp"
#include "report/config.hpp"

#include <string>
#include <vector>

/// Who leads a flow: fronts by mass, what they are made of, and how far the liquefied soil came.
namespace flowslide {

struct ParticleSet;
struct FinalState;

/// Share of the mass beyond the front of 1 % that is of one material.
struct FrontShare {
  std::string material;
  double share = 0.0;
};

struct Composition {
  Fronts fronts;                     ///< x, of all that counts [m]
  double height = kUnset;            ///< y above which 0.5 % of the counted mass lies [m]
  std::vector<FrontShare> foremost;  ///< of the foremost 1 %, the largest first
  bool liquefied = false;            ///< whether any material is liquefied soil
  Fronts liquefied_fronts;           ///< x, of the liquefied soil alone [m]
  double mass_past_toe = 0.0;        ///< [kg/m]
};

/// @param toe x [m]; unset: no mass past it
Composition composition(const ParticleSet& particles, const FinalState& end, double toe);

}  // namespace flowslide
