#pragma once
#include "config/schema.hpp"
#include "constitutive/admissible.hpp"
#include "constitutive/concept.hpp"
#include "constitutive/softening.hpp"

namespace flowslide {

/// Neo-Hookean elasticity for any strain: J sigma = mu (b - I) + lambda/2 (J^2 - 1) I. The left
/// Cauchy-Green tensor b needs no room of its own: stress and J hold it.
/// docs/theory/neo-hookean.md
struct NeoHookean {
  static constexpr std::string_view name = "neo_hookean";
  struct Params {
    double youngs_modulus = kUnset;  ///< E [Pa] at small strain
    double poisson_ratio = kUnset;   ///< nu [-]
  };
  template <class T>
  struct StateOf {
    T volume_ratio = 1.0;  ///< J [-]
  };
  using State = StateOf<double>;
  static constexpr std::array<std::string_view, 1> state_names{"volume_ratio"};
  struct Constants {
    Elasticity elastic;
  };

  static Elasticity elasticity(const Params& p) {
    return Elasticity::from_young(p.youngs_modulus, p.poisson_ratio);
  }
  static Constants constants(const Params& p, double /*softening_scale*/) {
    return {elasticity(p)};
  }
  static State initial_state(const Params&) { return {}; }

  template <int Dim, class T>
  [[nodiscard]] static StressUpdate<StateOf<T>, Dim, T> update(
      const Constants& c, const StateOf<T>& old, const Stress<Dim, T>& sigma,
      const StrainIncrement<Dim, T>& de) noexcept {
    const double mu = c.elastic.shear, lambda = c.elastic.bulk - 2.0 / 3.0 * mu;
    // (i) b of the last step, turned with the stress; (ii) b <- exp(de) b exp(de)
    const Tensor<T> b = push_forward(
        symmetric<Dim>(sigma.v, old.volume_ratio * (1.0 / mu),
                       1.0 - 0.5 * (lambda / mu) * (old.volume_ratio * old.volume_ratio - 1.0)),
        exponential(symmetric<Dim>(halved_shear(de), T(1.0), T(0.0))));
    // (iii) stress
    const T j = old.volume_ratio * exp_of_small(de[0] + de[1] + de[2]);
    const T inverse = 1.0 / j, isotropic = 0.5 * lambda * (j * j - 1.0) - mu;
    StressUpdate<StateOf<T>, Dim, T> r;
    for (int i = 0; i < kVoigt<Dim>; ++i)
      r.stress[i] = inverse * (mu * b[kRow[i]][kColumn[i]] + (i < 3 ? isotropic : T(0.0)));
    r.state.volume_ratio = j;
    return r;
  }
  static double present_strength(const Constants&, const State&) noexcept { return kUnset; }
  static AdmissibleStress admissible(const Constants&, const State&, const Stress<2>& total,
                                     LiquefiedReturn) {
    return any_stress(total);
  }
  /// At least rho c^2 of the fastest wave through the stretched material [Pa]: (K + 2 G)/J and the
  /// largest principal stress, bounded by the rows of the stress matrix.
  template <int Dim, class T>
  static T present_modulus(const Constants& c, const StateOf<T>& s,
                           const Stress<Dim, T>& sigma) noexcept {
    const Tensor<T> t = symmetric<Dim>(sigma.v, T(1.0), T(0.0));
    T tension = 0.0;
    for (int i = 0; i < 3; ++i) {
      T row = t[i][i];
      for (int j = 0; j < 3; ++j)
        if (j != i) row += max(t[i][j], T(-t[i][j]));
      tension = max(tension, row);
    }
    return (c.elastic.bulk + 2.0 * c.elastic.shear) / s.volume_ratio + tension;
  }

 private:
  template <class T>
  using Tensor = std::array<std::array<T, 3>, 3>;
  static constexpr int kRow[6] = {0, 1, 2, 0, 1, 2}, kColumn[6] = {0, 1, 2, 1, 2, 0};

  template <int Dim, class T>
  static std::array<T, kVoigt<Dim>> halved_shear(const StrainIncrement<Dim, T>& de) noexcept {
    std::array<T, kVoigt<Dim>> r = de.v;
    for (int i = 3; i < kVoigt<Dim>; ++i) r[i] *= 0.5;
    return r;
  }
  /// scale * v + diagonal * I
  template <int Dim, class T>
  static Tensor<T> symmetric(const std::array<T, kVoigt<Dim>>& v, T scale, T diagonal) noexcept {
    Tensor<T> r{};
    for (auto& row : r) row.fill(T(0.0));
    for (int i = 0; i < kVoigt<Dim>; ++i) {
      r[kRow[i]][kColumn[i]] = scale * v[i];
      r[kColumn[i]][kRow[i]] = scale * v[i];
    }
    for (int i = 0; i < 3; ++i) r[i][i] += diagonal;
    return r;
  }
  template <class T>
  static Tensor<T> product(const Tensor<T>& a, const Tensor<T>& b) noexcept {
    Tensor<T> r;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        r[i][j] = a[i][0] * b[0][j] + a[i][1] * b[1][j] + a[i][2] * b[2][j];
    return r;
  }
  /// I + e + e^2/2 + e^3/6, for the strain of a step.
  template <class T>
  static Tensor<T> exponential(const Tensor<T>& e) noexcept {
    const Tensor<T> e2 = product(e, e), e3 = product(e2, e);
    Tensor<T> r;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        r[i][j] = e[i][j] + 0.5 * e2[i][j] + (1.0 / 6.0) * e3[i][j] + (i == j ? 1.0 : 0.0);
    return r;
  }
  template <class T>
  static Tensor<T> push_forward(const Tensor<T>& b, const Tensor<T>& f) noexcept {
    return product(product(f, b), f);
  }
};
static_assert(ConstitutiveModel<NeoHookean, 2> && ConstitutiveModel<NeoHookean, 3>);

template <>
struct Schema<NeoHookean::Params> {
  static constexpr std::string_view doc = "Neo-Hookean elasticity for large strain.";
  static void describe(FieldVisitor& v, NeoHookean::Params& p) {
    v.quantity("youngs_modulus", p.youngs_modulus, Dim::stress, {.above = 0.0},
               "Young's modulus E at small strain");
    v.quantity("poisson_ratio", p.poisson_ratio, Dim::none, {.min = 0.0, .below = 0.5},
               "Poisson's ratio nu at small strain");
  }
};

}  // namespace flowslide
