#pragma once
#include "constitutive/drucker_prager.hpp"
#include "constitutive/law_list.hpp"
#include "constitutive/linear_elastic.hpp"
#include "constitutive/modified_cam_clay.hpp"
#include "constitutive/mohr_coulomb.hpp"
#include "constitutive/mu_i.hpp"
#include "constitutive/neo_hookean.hpp"
#include "constitutive/norsand.hpp"
#include "constitutive/pm4sand.hpp"
#include "constitutive/residual_strength.hpp"
#include "constitutive/shaking.hpp"
#include "constitutive/viscous_fluids.hpp"

#include <map>
#include <string>
#include <string_view>

/// The one list of constitutive laws. A new law: its header, a place in AllLaws, its test and its
/// theory page. Which solvers offer it follows from what it has.
namespace flowslide {

using AllLaws =
    LawList<PM4Sand, LinearElastic, NeoHookean, MohrCoulomb, DruckerPrager, ResidualStrength,
            ModifiedCamClay, NorSand, MuI, NewtonianFluid, Bingham, HerschelBulkley>;

/// Laws of the runout: those with an update in the plane and in space.
template <class M>
struct IsFlowLaw : std::bool_constant<ConstitutiveModel<M, 2> && ConstitutiveModel<M, 3>> {};
using FlowLaws = Filtered<AllLaws, IsFlowLaw>;
using AnyMaterial = FlowLaws::Variant<Material>;
using MaterialSettings = LawSettings<FlowLaws>;

/// A transfer asks every law of the runout what it can carry.
template <class M>
struct IsAdmitting : std::bool_constant<AdmitsStress<M>> {};
static_assert(Filtered<FlowLaws, IsAdmitting>::size == FlowLaws::size,
              "a law of the runout has no `admissible`");

/// Laws of the shaking.
template <class M>
struct IsShakingLaw : std::bool_constant<ShakingModel<M>> {};
using ShakingLaws = Filtered<AllLaws, IsShakingLaw>;

/// A law by name and its parameters in SI by name, as ParticleSet carries them.
struct LawParameters {
  std::string law;
  std::map<std::string, double> parameters;
};
LawParameters to_parameters(const AnyMaterial& material);
/// The inverse; throws InputError for an unknown law, unknown, missing or out-of-range parameters.
AnyMaterial from_parameters(std::string_view law, const std::map<std::string, double>& parameters);

}  // namespace flowslide
