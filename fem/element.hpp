#pragma once
#include "fem/model.hpp"

#include <array>
#include <vector>

/// Stabilised single-point quadrilaterals (McGann, Arduino & Mackenzie-Helnwein 2012), small
/// strains, plane strain. Structure of arrays: entry e of each vector belongs to element e.
namespace flowslide::fem {

struct Elements {
  std::array<std::vector<double>, 4> bx, by;  ///< gradient of shape functions at the centre [1/m]
  std::array<std::vector<double>, 4> gamma;   ///< hourglass vector [-]
  std::vector<double> area;                   ///< [m2]
  std::vector<double> volume;                 ///< area times thickness [m3]
  /// 4 H times thickness, to be multiplied by a shear modulus: stiffness of the hourglass modes.
  std::vector<double> hss, hst, htt;
  /// Share of the four nodes in the volume.
  std::array<std::vector<double>, 4> share;
  [[nodiscard]] std::size_t size() const { return area.size(); }
};

/// Geometry of the elements of a mesh in the order given by `order`.
Elements make_elements(const Model& model, const std::vector<std::int32_t>& order);

}  // namespace flowslide::fem
