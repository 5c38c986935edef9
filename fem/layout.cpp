#include "fem/layout.hpp"

#include <algorithm>
#include <numeric>

namespace flowslide::fem {

Layout make_layout(const Model& model) {
  const std::size_t n = model.mesh.num_elements();
  Layout r;
  const auto law_of = [&](std::int32_t e) {
    return model.materials[model.material[e]].law.index();
  };
  r.order.resize(n);
  std::iota(r.order.begin(), r.order.end(), 0);
  std::stable_sort(r.order.begin(), r.order.end(), [&](std::int32_t a, std::int32_t b) {
    return std::pair(law_of(a), model.material[a]) < std::pair(law_of(b), model.material[b]);
  });
  r.law_begin.fill(0);
  for (const std::int32_t e : r.order) ++r.law_begin[law_of(e) + 1];
  std::partial_sum(r.law_begin.begin(), r.law_begin.end(), r.law_begin.begin());

  r.elements = make_elements(model, r.order);
  r.material.resize(n);
  r.nodes.resize(n);
  r.dofs.resize(n);
  r.saturated.resize(n);
  r.mass.assign(model.num_dofs + 1, 0.0);
  r.weight.assign(model.num_dofs + 1, 0.0);
  std::vector<std::int32_t> unknown(8 * n);
  for (std::size_t k = 0; k < n; ++k) {
    const std::int32_t e = r.order[k];
    const Material& m = model.materials[model.material[e]];
    r.material[k] = model.material[e];
    r.nodes[k] = model.mesh.elements[e];
    bool wet = false;
    for (int i = 0; i < 4; ++i) {
      const std::int32_t node = r.nodes[k][i];
      wet = wet || !is_set(model.known_pressure[node]);
      const double share = m.density * r.elements.volume[k] * r.elements.share[i][k];
      for (int d = 0; d < 2; ++d) {
        const std::int32_t u = model.dof[node][d];
        r.dofs[k][2 * i + d] = unknown[8 * k + 2 * i + d] = u;
        r.mass[u] += share;
      }
      r.weight[model.dof[node][1]] -= share * model.gravity;
    }
    r.saturated[k] = wet && !m.drained;
  }
  r.forces = make_gather(unknown, model.num_dofs);
  return r;
}

}  // namespace flowslide::fem
