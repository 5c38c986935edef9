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

/// Relations between parameters, for laws that have a check().
template <class Params>
void check_relations(const Params& p) {
  if constexpr (requires { check(p); }) check(p);
}

template <class M>
void read_law(std::string_view law, const std::map<std::string, double>& parameters,
              std::optional<AnyMaterial>& result) {
  if (law != M::name) return;
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
}

}  // namespace

namespace {

/// What Mohr-Coulomb and its cone have in common.
template <class Params>
void check_friction(std::string_view law, const Params& p) {
  const double degrees = 57.29577951308232;
  validate(!p.residual_friction_angle || *p.residual_friction_angle <= p.friction_angle,
           "{}: residual friction angle {:.1f} deg exceeds the peak {:.1f} deg (softening would "
           "harden) swap them?",
           law, p.residual_friction_angle.value_or(0.0) * degrees, p.friction_angle * degrees);
  validate(!p.residual_cohesion || *p.residual_cohesion <= p.cohesion,
           "{}: residual cohesion {:g} kPa exceeds the peak {:g} kPa (softening would harden) swap "
           "them?",
           law, p.residual_cohesion.value_or(0.0) * 1e-3, p.cohesion * 1e-3);
  validate(p.dilation_angle <= p.friction_angle,
           "{}: dilation angle {:.1f} deg exceeds the friction angle {:.1f} deg (shearing would "
           "create energy) use a smaller one",
           law, p.dilation_angle * degrees, p.friction_angle * degrees);
  validate(p.cohesion > 0.0 || p.friction_angle > 0.0,
           "{}: cohesion and friction angle are both zero (no strength at all) give one of them",
           law);
}

}  // namespace

void check(const MohrCoulomb::Params& p) { check_friction(MohrCoulomb::name, p); }
void check(const DruckerPrager::Params& p) { check_friction(DruckerPrager::name, p); }

void check(const ModifiedCamClay::Params& p) {
  validate(p.compression_index > p.swelling_index,
           "modified_cam_clay: compression_index {} does not exceed swelling_index {} (virgin soil "
           "is softer than swelling soil) swap them?",
           p.compression_index, p.swelling_index);
}

void check(const NorSand::Params& p) {
  validate(
      p.csl_slope * p.dilatancy < p.critical_ratio,
      "norsand: csl_slope x dilatancy is {:.3g}, not below critical_ratio {} (the dilatancy of "
      "the image state has no value) use a smaller dilatancy",
      p.csl_slope * p.dilatancy, p.critical_ratio);
}

void check(const PM4Sand::Params& p) { (void)PM4Sand::constants(p); }

void check(const MuI::Params& p) {
  validate(p.mu_limit >= p.mu_static,
           "mu_i: mu_limit {} is below mu_static {} (faster flow would be weaker, which has no "
           "unique answer) swap them?",
           p.mu_limit, p.mu_static);
  validate(p.mu_static < 0.95 || p.lode_dependence == 0.0,
           "mu_i: mu_static is {} (in plane flow it is the sine of the angle of friction, and the "
           "72 degrees of 0.95 are out of reach of grains) take the tangent of an angle of repose, "
           "or lode_dependence: 0",
           p.mu_static);
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
  std::optional<AnyMaterial> result;
  FlowLaws::each([&]<class M>() { read_law<M>(law, parameters, result); });
  validate(result.has_value(), "unknown constitutive law '{}'", law);
  return *result;
}

}  // namespace flowslide
