#pragma once
#include "tests/mpm/scene.hpp"

/// Small scenes in three dimensions.
namespace flowslide::mpm {

struct Block {
  std::array<double, 3> from, to;
};

/// Fills it with points at the centres of cubes of side `spacing`, x fastest.
inline void add_block(ParticleSet& p, const Block& block, double spacing, double density) {
  p.dim = 3;
  std::array<int, 3> n;
  for (int d = 0; d < 3; ++d)
    n[d] = static_cast<int>(std::lround((block.to[d] - block.from[d]) / spacing));
  resize(p, std::size_t(n[0]) * n[1] * n[2]);
  for (std::size_t q = 0; q < p.size(); ++q) {
    const std::array<std::size_t, 3> at{q % n[0], q / n[0] % n[1], q / n[0] / n[1]};
    for (int d = 0; d < 3; ++d) p.position[q][d] = block.from[d] + (double(at[d]) + 0.5) * spacing;
    p.volume[q] = spacing * spacing * spacing;
    p.mass[q] = density * p.volume[q];
    p.material[q] = 0;
    p.id[q] = static_cast<std::int64_t>(q) + 1;
  }
}

struct Run3 {
  Simulation<3> s;
  StepScratch<3> scratch;
  Reference<3> start;
  Run3(const ParticleSet& particles, const FlowConfig& config, int threads = 1)
      : s(make_simulation<3>(particles, config)), scratch(threads) {
    prepare(s, scratch, true);
    start = {sum_points(s), is_set(particles.toe) ? particles.toe : 0.0};
  }
  void step(int count = 1) {
    for (int i = 0; i < count; ++i) advance(s, scratch);
  }
};

}  // namespace flowslide::mpm
