#pragma once
#include "config/schema.hpp"

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <variant>

/// Lists of laws as types, and what follows from a list: settings, variants, loops over laws.
namespace flowslide {

template <class... M>
struct LawList {
  static constexpr std::size_t size = sizeof...(M);
  template <template <class> class F>
  using Variant = std::variant<F<M>...>;
  template <template <class> class F>
  using Tuple = std::tuple<F<M>...>;
  using Settings = std::tuple<std::optional<typename M::Params>...>;
  /// The laws of this list for which `Is` holds, in their order.
  template <template <class> class Is>
  using Where = decltype(std::tuple_cat(
      std::declval<
          std::conditional_t<Is<M>::value, std::tuple<std::type_identity<M>>, std::tuple<>>>()...));
  /// Place of law `L` in the list.
  template <class L>
  static constexpr std::size_t index() {
    constexpr std::array<bool, sizeof...(M)> same{std::is_same_v<L, M>...};
    for (std::size_t i = 0; i < same.size(); ++i)
      if (same[i]) return i;
    return same.size();
  }
  /// Calls f.template operator()<M>() for every law in order.
  template <class F>
  static void each(F&& f) {
    (f.template operator()<M>(), ...);
  }
};

namespace detail {
template <class Tuple>
struct ListOf;
template <class... M>
struct ListOf<std::tuple<std::type_identity<M>...>> {
  using type = LawList<M...>;
};
}  // namespace detail

/// The part of a list for which `Is` holds.
template <class List, template <class> class Is>
using Filtered = typename detail::ListOf<typename List::template Where<Is>>::type;

/// A law of `Laws` as users write it: exactly one of the groups, named as the law.
template <class Laws>
struct LawSettings {
  typename Laws::Settings laws;
  template <class M>
  std::optional<typename M::Params>& of() {
    return std::get<std::optional<typename M::Params>>(laws);
  }
  template <class M>
  [[nodiscard]] const std::optional<typename M::Params>& of() const {
    return std::get<std::optional<typename M::Params>>(laws);
  }
};

/// Visits the fields of LawSettings inside a larger Schema.
template <class Laws>
void describe_laws(FieldVisitor& v, LawSettings<Laws>& m) {
  Laws::each(
      [&]<class M>() { v.group(M::name, m.template of<M>(), Schema<typename M::Params>::doc); });
}

/// Names of all laws of a list, separated by commas.
template <class Laws>
std::string law_names() {
  std::string names;
  Laws::each([&]<class M>() { names.append(names.empty() ? "" : ", ").append(M::name); });
  return names;
}

template <class M>
struct Material {
  typename M::Params params;
};

/// Exactly one law, with consistent parameters. Throws InputError; `where` names the material.
template <class Laws>
typename Laws::template Variant<Material> make_material(const LawSettings<Laws>& m,
                                                        std::string_view where) {
  int given = 0;
  typename Laws::template Variant<Material> chosen;
  Laws::each([&]<class M>() {
    if (!m.template of<M>()) return;
    ++given;
    chosen = Material<M>{*m.template of<M>()};
  });
  validate(given == 1,
           "material '{}' has {} constitutive laws (exactly one is needed) give one of {}", where,
           given, law_names<Laws>());
  std::visit(
      [](const auto& law) {
        if constexpr (requires { check(law.params); }) check(law.params);
      },
      chosen);
  return chosen;
}

}  // namespace flowslide
