#pragma once
#include "config/schema.hpp"

#include <functional>
#include <string>
#include <string_view>

/// Documentation made from the same Schema<T> that reads the settings.
namespace flowslide {

namespace detail {
std::string manual_fields(std::string_view title, std::string_view doc,
                          const std::function<void(FieldVisitor&)>& describe);
std::string json_schema_fields(std::string_view doc,
                               const std::function<void(FieldVisitor&)>& describe);
}  // namespace detail

/// Manual page in Markdown: one table of all keys with kind and units, default, allowed values and
/// meaning. Keys of groups are joined by dots; `key[]` is an item of a list, `key.<name>` an entry
/// of a table.
template <class T>
std::string manual_page(std::string_view title) {
  T settings{};
  return detail::manual_fields(title, Schema<T>::doc,
                               [&](FieldVisitor& v) { Schema<T>::describe(v, settings); });
}

/// JSON text of a JSON Schema (draft 2020-12) object without "$schema", so that schemas of stages
/// can be put into one. Quantities are texts that must end in one of the units; every single value
/// may also be a reference "${path.to.key}"; unknown keys are refused.
template <class T>
std::string json_schema() {
  T settings{};
  return detail::json_schema_fields(Schema<T>::doc,
                                    [&](FieldVisitor& v) { Schema<T>::describe(v, settings); });
}

}  // namespace flowslide
