#include "fem/model.hpp"

#include "core/check.hpp"

namespace flowslide::fem {
namespace {

void check(const Material& m) {
  validate(std::isfinite(m.density) && m.density > 0.0,
           "material {}: the density is {} kg/m3 (it must be positive)", m.name, m.density);
  validate(m.porosity > 0.0 && m.porosity < 1.0,
           "material {}: the porosity is {} (it must lie between 0 and 1)", m.name, m.porosity);
  for (const double k : m.permeability)
    validate(std::isfinite(k) && k >= 0.0,
             "material {}: a permeability is {} m/s (it must not be negative)", m.name, k);
  validate(m.gravity_poisson >= 0.0 && m.gravity_poisson < 0.5,
           "material {}: Poisson's ratio under gravity is {} (it must lie between 0 and 0.5)",
           m.name, m.gravity_poisson);
}

}  // namespace

void check(const Model& m) {
  flowslide::check(m.mesh);
  const std::size_t nodes = m.mesh.num_nodes(), elements = m.mesh.num_elements();
  validate(m.material.size() == elements && m.thickness.size() == elements &&
               m.dof.size() == nodes && m.known_pressure.size() == nodes &&
               m.load.size() == static_cast<std::size_t>(m.num_dofs) + 1 &&
               (m.base_dashpots.empty() || m.base_dashpots.size() == m.base_dofs.size()),
           "a field of the finite-element model does not have one value for each of its {} nodes, "
           "{} elements or {} unknowns",
           nodes, elements, m.num_dofs);
  for (const Material& material : m.materials) check(material);
  validate(m.fluid.bulk_modulus > 0.0 && m.fluid.density > 0.0 && m.gravity > 0.0,
           "bulk modulus, density of water and gravity must be positive, not {} Pa, {} kg/m3, {} "
           "m/s2",
           m.fluid.bulk_modulus, m.fluid.density, m.gravity);
  for (std::size_t e = 0; e < elements; ++e) {
    validate(m.material[e] >= 0 && static_cast<std::size_t>(m.material[e]) < m.materials.size(),
             "element {} has no material", m.mesh.element_tags[e]);
    validate(std::isfinite(m.thickness[e]) && m.thickness[e] > 0.0,
             "element {}: the thickness is {} m (it must be positive)", m.mesh.element_tags[e],
             m.thickness[e]);
  }
}

}  // namespace flowslide::fem
