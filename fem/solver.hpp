#pragma once
#include "fem/layout.hpp"
#include "fem/pressure.hpp"

#include <cstdint>
#include <vector>

/// State of a run and its explicit step: central differences for the motion, an implicit solve of
/// constant matrix for the pore pressure. docs/theory/fem.md
namespace flowslide::fem {

inline constexpr std::int32_t kChunk = 32;  ///< elements or unknowns in one piece of work

struct Damping {
  double mass = 0.0;       ///< Rayleigh factor of the mass [1/s]
  double stiffness = 0.0;  ///< Rayleigh factor of the present elastic stiffness of the soil [s]
};

/// Integrals since the start of the run [J].
struct Energy {
  double kinetic = 0.0;      ///< now
  double deformation = 0.0;  ///< work of total stress and hourglass forces
  double damping = 0.0;      ///< lost in mass damping and dashpots
  double viscous = 0.0;      ///< lost in stiffness damping; contained in `deformation`
  double weight = 0.0;       ///< done by gravity and constant loads
  double base = 0.0;         ///< done by the ground motion
  /// |kinetic + deformation + damping - weight - base| over the sum of their magnitudes.
  [[nodiscard]] double error() const;
};

/// Rates of work, or work [W, J].
struct Power {
  double damping = 0.0, weight = 0.0, base = 0.0;
  Power& operator+=(const Power& o) {
    damping += o.damping;
    weight += o.weight;
    base += o.base;
    return *this;
  }
};

/// States of the elements of one law.
template <class M>
struct LawStates {
  std::vector<typename M::State> of;
};

/// Constants of one law, of each material; unused entries are empty.
template <class M>
struct LawConstants {
  std::vector<typename M::Constants> of;
};

/// What changes in time.
struct State {
  double time = 0.0;  ///< [s]
  std::int64_t step = 0;
  std::vector<double> displacement;              ///< of each unknown, since the end of gravity [m]
  std::vector<double> velocity;                  ///< half a step before `time` [m/s]
  std::vector<double> pressure;                  ///< of each node [Pa]
  std::vector<Stress<2>> stress;                 ///< effective, of each solver element [Pa]
  std::vector<double> hourglass_x, hourglass_y;  ///< hourglass displacements, gravity included [m]
  ShakingLaws::Tuple<LawStates> laws;            ///< of the elements of each law, in their order
  double last_dt = 0.0;                          ///< step before the present one [s]
  Energy energy;                                 ///< at the start of the last step
  Power pending;  ///< work of its second half of the step, counted with the next [J]
  double pending_deformation = 0.0, pending_viscous = 0.0;
};

struct Counters {
  std::int64_t sub_steps = 0;  ///< of laws that divide their steps, accepted
  std::int64_t rejected = 0;
  std::int64_t floored = 0;  ///< that ended at the floor of mean stress
};

struct Solver {
  Model model;
  Layout layout;
  PressureSystem water;
  ShakingLaws::Tuple<LawConstants> laws;
  Damping damping;                                ///< as asked for; stiffness_damping may be less
  std::vector<double> hourglass_shear;            ///< shear modulus of the hourglass stiffness [Pa]
  std::vector<ShearStrength> hourglass_strength;  ///< of each material; what it may carry
  std::vector<double> hourglass_rest;  ///< hourglass stress at rest, which stays admissible [Pa]
  /// Pore pressure and vertical effective stress (compression positive) of each element at rest
  /// [Pa]; empty where no permeability follows the pore pressure.
  std::vector<double> rest_pressure, rest_weight;

  State state;
  double dt = kUnset;                     ///< present step [s]
  std::vector<double> lambda, shear;      ///< present elastic constants of each element [Pa]
  std::vector<double> stiffness_damping;  ///< factor of the elastic stiffness of each element [s]
  Counters counters;

  // Within a step.
  std::vector<double> strain;         ///< increments, xx yy xy of each element in turn
  std::vector<double> entry_force;    ///< internal forces, 8 of each element [N]
  std::vector<double> entry_flow;     ///< water that flows to its nodes, 4 of each element [m3/s]
  std::vector<double> pressure_rate;  ///< of each equation [Pa/s]
  std::vector<double> dashpot;        ///< of each unknown, base and mass damping [N s/m]
  std::vector<double> base_drive;     ///< dashpots at the base, of each unknown [N s/m]
  std::vector<std::uint8_t> prescribed;  ///< unknowns that follow the ground
  struct ChunkSums {
    double deformation = 0.0, viscous = 0.0;
    double largest_strain = 0.0;
    std::int32_t failed = -1;  ///< first element whose stress is not finite
  };
  std::vector<ChunkSums> element_sums;
  struct UnknownSums {
    double kinetic = 0.0;
    Power before, after;  ///< with the velocities before and after
  };
  std::vector<UnknownSums> unknown_sums;
};

/// State of solver element `e`, and constants of a material, of law M.
template <class M>
typename M::State& state_of(Solver& s, std::size_t e) {
  const std::size_t first = s.layout.law_begin[ShakingLaws::index<M>()];
  return std::get<LawStates<M>>(s.state.laws).of[e - first];
}
template <class M>
const typename M::Constants& constants_of(const Solver& s, std::int32_t material) {
  return std::get<LawConstants<M>>(s.laws).of[material];
}

/// Pore pressure in the middle of a solver element [Pa].
inline double mean_pressure(const Solver& s, std::size_t e) {
  double sum = 0.0;
  for (const std::int32_t node : s.layout.nodes[e]) sum += s.state.pressure[node];
  return 0.25 * sum;
}

/// Elastic constants of the stage of gravity.
Elasticity gravity_elasticity(const Material& m);

/// Allocates everything; stress, pressure and laws are empty until solve_gravity.
Solver make_solver(const Model& model, const Damping& damping);

/// Hourglass stress of an element: the root mean square of the shear stress of the assumed strain
/// [Pa].
double hourglass_stress(const Solver& s, std::size_t e);

/// From here on hourglass stress is bounded by the strength of the soil at its present mean
/// effective stress, or by the hourglass stress that it has now. docs/theory/fem.md, "Element".
void let_hourglass_yield(Solver& s);

/// Recomputes `lambda` and `shear` from the present state.
void refresh_moduli(Solver& s);

/// Forces of the present stress and pressure, without damping; for the start of a run.
void start_motion(Solver& s);

/// Ground velocity [m/s] at the start and the end of the step.
struct BaseMotion {
  double start = 0.0, end = 0.0;
};

/// One step of s.dt. Nothing in it allocates or depends on the number of threads. Throws
/// NumericsError naming element and time when a stress is not finite or an element deforms by more
/// than 20 % in the step.
void advance(Solver& s, const BaseMotion& base);

}  // namespace flowslide::fem
