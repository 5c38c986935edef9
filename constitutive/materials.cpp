#include "constitutive/materials.hpp"

#include <set>

namespace flowslide {
namespace {

/// Walks a law's parameters, which are plain numbers, and hands each to
/// `f(key, value, range, needed)`.
/// A law with another kind of parameter does not compile against ParticleSet and is refused.
template <class F>
class NumberVisitor final : public FieldVisitor {
 public:
  explicit NumberVisitor(F f) : f_(std::move(f)) {}
  void quantity(std::string_view key, double& value, Dim, Range range, std::string_view) override {
    std::optional<double> x = is_set(value) ? std::optional(value) : std::nullopt;
    f_(key, x, range, true);
    value = x.value_or(kUnset);
  }
  void quantity(std::string_view key, std::optional<double>& value, Dim, Range range,
                std::string_view) override {
    f_(key, value, range, false);
  }
  void integer(std::string_view, int&, Range, std::string_view) override { refuse(); }
  void flag(std::string_view, bool&, std::string_view) override { refuse(); }
  void text(std::string_view, std::string&, std::string_view) override { refuse(); }
  void text(std::string_view, std::optional<std::string>&, std::string_view) override { refuse(); }
  void file(std::string_view, InputFile&, std::string_view) override { refuse(); }
  void file(std::string_view, std::optional<InputFile>&, std::string_view) override { refuse(); }
  void tuple(std::string_view, std::span<double>, Dim, std::string_view) override { refuse(); }
  void numbers(std::string_view, std::vector<double>&, Dim, std::string_view) override { refuse(); }
  void integers(std::string_view, std::vector<int>&, std::string_view) override { refuse(); }
  void texts(std::string_view, std::vector<std::string>&, std::string_view) override { refuse(); }
  void rows(std::string_view, std::vector<std::vector<double>>&, std::span<const Column>,
            std::string_view) override {
    refuse();
  }

 protected:
  void choice_index(std::string_view, int&, std::span<const std::string_view>,
                    std::string_view) override {
    refuse();
  }
  bool begin_group(std::string_view, Presence, std::string_view) override { return refuse(); }
  void end_group() override {}
  std::size_t begin_list(std::string_view, std::size_t, std::string_view) override {
    return refuse();
  }
  bool begin_item(std::size_t) override { return refuse(); }
  void end_list() override {}
  std::vector<std::string> begin_table(std::string_view, const std::vector<std::string>&,
                                       std::string_view) override {
    refuse();
    return {};
  }
  bool begin_entry(const std::string&) override { return refuse(); }
  void end_table() override {}

 private:
  static bool refuse() {
    throw std::logic_error("parameters of a constitutive law must be numbers");
  }
  F f_;
};

template <class Params, class F>
void for_each_number(Params& p, F f) {
  NumberVisitor<F> visitor(std::move(f));
  Schema<Params>::describe(visitor, p);
}

void check_relations(const MohrCoulomb::Params& p) { check(p); }
template <class Params>
void check_relations(const Params&) {}

template <class M>
bool read_law(std::string_view law, const std::map<std::string, double>& parameters,
              std::optional<AnyMaterial>& result) {
  if (law != M::name) return false;
  typename M::Params p;
  std::set<std::string> known;
  for_each_number(p, [&](std::string_view key, std::optional<double>& value, const Range& range,
                         bool needed) {
    known.emplace(key);
    const auto found = parameters.find(std::string(key));
    if (found != parameters.end()) value = found->second;
    validate(value || !needed, "{}: {} is missing (the law cannot do without) give it", law, key);
    validate(!value || range.contains(*value), "{}: {} = {} is out of its range", law, key,
             value.value_or(kUnset));
  });
  for (const auto& [key, value] : parameters)
    validate(known.count(key) == 1, "{} has no parameter '{}'", law, key);
  check_relations(p);
  result = Material<M>{p};
  return true;
}

template <class Variant, std::size_t... I>
std::optional<AnyMaterial> read_any(std::string_view law,
                                    const std::map<std::string, double>& parameters,
                                    std::index_sequence<I...>) {
  std::optional<AnyMaterial> result;
  const auto try_one = [&]<class M>(std::type_identity<Material<M>>) {
    return read_law<M>(law, parameters, result);
  };
  (try_one(std::type_identity<std::variant_alternative_t<I, Variant>>{}) || ...);
  return result;
}

}  // namespace

void check(const MohrCoulomb::Params& p) {
  const double degrees = 57.29577951308232;
  validate(!p.residual_friction_angle || *p.residual_friction_angle <= p.friction_angle,
           "mohr_coulomb: residual friction angle {:.1f} deg exceeds the peak {:.1f} deg "
           "(softening would "
           "harden) swap them?",
           p.residual_friction_angle.value_or(0.0) * degrees, p.friction_angle * degrees);
  validate(p.dilation_angle <= p.friction_angle,
           "mohr_coulomb: dilation angle {:.1f} deg exceeds the friction angle {:.1f} deg "
           "(shearing would "
           "create energy) use a smaller one",
           p.dilation_angle * degrees, p.friction_angle * degrees);
  validate(p.cohesion > 0.0 || p.friction_angle > 0.0,
           "mohr_coulomb: cohesion and friction angle are both zero (no strength at all) give one "
           "of them");
}

void describe_laws(FieldVisitor& v, MaterialSettings& m) {
  v.group("linear_elastic", m.linear_elastic, Schema<LinearElastic::Params>::doc);
  v.group("mohr_coulomb", m.mohr_coulomb, Schema<MohrCoulomb::Params>::doc);
  v.group("residual_strength", m.residual_strength, Schema<ResidualStrength::Params>::doc);
}

AnyMaterial make_material(const MaterialSettings& m, std::string_view where) {
  const int given = int(m.linear_elastic.has_value()) + int(m.mohr_coulomb.has_value()) +
                    int(m.residual_strength.has_value());
  validate(
      given == 1,
      "material '{}' has {} constitutive laws (exactly one is needed) give one of linear_elastic, "
      "mohr_coulomb, residual_strength",
      where, given);
  if (m.linear_elastic) return Material<LinearElastic>{*m.linear_elastic};
  if (m.residual_strength) return Material<ResidualStrength>{*m.residual_strength};
  check(*m.mohr_coulomb);
  return Material<MohrCoulomb>{*m.mohr_coulomb};
}

LawParameters to_parameters(const AnyMaterial& material) {
  return std::visit(
      []<class M>(const Material<M>& m) {
        LawParameters r{std::string(M::name), {}};
        typename M::Params p = m.params;
        for_each_number(
            p, [&](std::string_view key, std::optional<double>& value, const Range&, bool) {
              if (value) r.parameters.emplace(key, *value);
            });
        return r;
      },
      material);
}

AnyMaterial from_parameters(std::string_view law, const std::map<std::string, double>& parameters) {
  auto result = read_any<AnyMaterial>(law, parameters,
                                      std::make_index_sequence<std::variant_size_v<AnyMaterial>>{});
  validate(result.has_value(), "unknown constitutive law '{}'", law);
  return *result;
}

}  // namespace flowslide
