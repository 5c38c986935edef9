#pragma once
#include "constitutive/linear_elastic.hpp"
#include "constitutive/mohr_coulomb.hpp"
#include "constitutive/residual_strength.hpp"

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <variant>

/// The one list of constitutive laws. A new law: its header, a line in each of the three places
/// below, its test and its theory page.
namespace flowslide {

template <class M>
struct Material {
  typename M::Params params;
};
using AnyMaterial =
    std::variant<Material<LinearElastic>, Material<MohrCoulomb>, Material<ResidualStrength>>;

/// A law as users write it: exactly one of the groups.
struct MaterialSettings {
  std::optional<LinearElastic::Params> linear_elastic;
  std::optional<MohrCoulomb::Params> mohr_coulomb;
  std::optional<ResidualStrength::Params> residual_strength;
};

/// Visits the fields of MaterialSettings inside a larger Schema.
void describe_laws(FieldVisitor& v, MaterialSettings& m);

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
