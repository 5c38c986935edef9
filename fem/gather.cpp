#include "fem/gather.hpp"

namespace flowslide::fem {

Gather make_gather(const std::vector<std::int32_t>& unknown, std::int32_t num_unknowns) {
  Gather g;
  g.start.assign(num_unknowns + 1, 0);
  for (const std::int32_t u : unknown)
    if (u < num_unknowns) ++g.start[u + 1];
  for (std::int32_t u = 0; u < num_unknowns; ++u) g.start[u + 1] += g.start[u];
  g.entry.resize(g.start[num_unknowns]);
  std::vector<std::int32_t> next(g.start.begin(), g.start.end() - 1);
  for (std::size_t k = 0; k < unknown.size(); ++k)
    if (unknown[k] < num_unknowns) g.entry[next[unknown[k]]++] = static_cast<std::int32_t>(k);
  return g;
}

}  // namespace flowslide::fem
