#include "mpm/run/load.hpp"

#include <bit>

namespace flowslide::mpm {

template <int Dim>
void store_frame(const Simulation<Dim>& s, MpmFrame& frame) {
  const std::size_t n = s.points.size() + s.gone.size();
  frame.time = s.time;
  frame.position.resize(n);
  frame.velocity.resize(n);
  frame.stress.resize(n);
  frame.volume.resize(n);
  frame.plastic_strain.resize(n);
  frame.strength.resize(n);
  const auto store = [&](const Points<Dim>& p, std::size_t q, double volume) {
    const auto i = static_cast<std::size_t>(p.index[q]);
    frame.position[i] = frame.velocity[i] = {};
    frame.stress[i] = {};
    for (int d = 0; d < Dim; ++d) {
      frame.position[i][d] = p.x[d][q];
      frame.velocity[i][d] = p.v[d][q];
    }
    for (int k = 0; k < kVoigt<Dim>; ++k) frame.stress[i][k] = p.sigma[k][q];
    frame.volume[i] = volume;
    std::visit(
        [&]<class M>(const Typed<M>& law) {
          constexpr std::size_t states = M::state_names.size();
          std::array<double, states> values{};
          for (std::size_t k = 0; k < states; ++k) values[k] = p.state[k][q];
          typename M::State state{};
          if constexpr (states > 0) state = std::bit_cast<typename M::State>(values);
          frame.plastic_strain[i] = 0.0;
          if constexpr (requires { state.plastic_strain; })
            frame.plastic_strain[i] = state.plastic_strain;
          frame.strength[i] = M::present_strength(law.constants, state);
        },
        s.materials[p.material[q]].law);
  };
  for (std::size_t q = 0; q < s.points.size(); ++q) store(s.points, q, s.points.volume[q]);
  for (std::size_t q = 0; q < s.gone.size(); ++q) store(s.gone, q, 0.0);
}

template void store_frame<2>(const Simulation<2>&, MpmFrame&);
template void store_frame<3>(const Simulation<3>&, MpmFrame&);

}  // namespace flowslide::mpm
