#pragma once
#include "mpm/walls/contact.hpp"

/// The solution for the impulses of wall points; shared by what uses it.
namespace flowslide::mpm {

/// What the dashpots of absorbing planes do in a solution.
enum class Ends {
  idle,   ///< nothing
  stop,   ///< stop what comes
  drain,  ///< act as dashpots
};

template <int Dim>
void solve(const StaggeredArray<Node>& nodes, Contact<Dim>& c, double full_mass, Hold hold,
           std::vector<typename Contact<Dim>::Vector>& impulse, Ends ends = Ends::idle,
           double dt = 0.0) noexcept;

/// Velocity of the soil at a wall point [m/s].
template <int Dim>
std::array<double, Dim> surface_velocity(const Contact<Dim>& c,
                                         const WallPoint<Dim>& wall) noexcept {
  std::array<double, Dim> u{};
  for (std::int32_t e = wall.first; e < wall.last; ++e)
    for (int d = 0; d < Dim; ++d) u[d] += c.weight[e] * c.velocity[c.node[e]][d];
  return u;
}

}  // namespace flowslide::mpm
