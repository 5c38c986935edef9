#pragma once
#include "constitutive/drucker_prager.hpp"
#include "constitutive/linear_elastic.hpp"
#include "constitutive/modified_cam_clay.hpp"
#include "constitutive/mohr_coulomb.hpp"
#include "constitutive/mu_i.hpp"
#include "constitutive/neo_hookean.hpp"
#include "constitutive/norsand.hpp"
#include "constitutive/residual_strength.hpp"
#include "constitutive/viscous_fluids.hpp"

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <variant>

/// The one list of constitutive laws. A new law: its header, a place in AllLaws, its test and its
/// theory page.
namespace flowslide {

template <class M>
struct Material {
  typename M::Params params;
};

template <class... M>
struct LawList {
  template <template <class> class F>
  using Variant = std::variant<F<M>...>;
  using Settings = std::tuple<std::optional<typename M::Params>...>;
  /// Calls f.template operator()<M>() for every law in order.
  template <class F>
  static void each(F&& f) {
    (f.template operator()<M>(), ...);
  }
};
using AllLaws = LawList<LinearElastic, NeoHookean, MohrCoulomb, DruckerPrager, ResidualStrength,
                        ModifiedCamClay, NorSand, MuI, NewtonianFluid, Bingham, HerschelBulkley>;
using AnyMaterial = AllLaws::Variant<Material>;

/// A law as users write it: exactly one of the groups, named as the law.
struct MaterialSettings {
  AllLaws::Settings laws;
  template <class M>
  std::optional<typename M::Params>& of() {
    return std::get<std::optional<typename M::Params>>(laws);
  }
  template <class M>
  [[nodiscard]] const std::optional<typename M::Params>& of() const {
    return std::get<std::optional<typename M::Params>>(laws);
  }
};

/// Visits the fields of MaterialSettings inside a larger Schema.
void describe_laws(FieldVisitor& v, MaterialSettings& m);

/// How many laws are given, and the names of all that there are, separated by commas.
int count_given(const MaterialSettings& m);
std::string law_names();

/// Exactly one law, with consistent parameters. Throws InputError; `where` names the material.
AnyMaterial make_material(const MaterialSettings& m, std::string_view where);

/// A law by name and its parameters in SI by name, as ParticleSet carries them.
struct LawParameters {
  std::string law;
  std::map<std::string, double> parameters;
};
LawParameters to_parameters(const AnyMaterial& material);
/// The inverse; throws InputError for an unknown law, unknown, missing or out-of-range parameters.
AnyMaterial from_parameters(std::string_view law, const std::map<std::string, double>& parameters);

}  // namespace flowslide
