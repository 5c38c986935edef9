#pragma once
#include "config/schema.hpp"
#include "core/hashed_file.hpp"

#include <functional>
#include <string>
#include <vector>

namespace flowslide {

/// Settings as text, and the files whose content the text stands for.
struct CanonicalSettings {
  std::string text;               ///< see canonical_text
  std::vector<HashedFile> files;  ///< in order of declaration
};

namespace detail {
CanonicalSettings canonical_settings(const std::function<void(FieldVisitor&)>& describe);
}  // namespace detail

template <class T>
CanonicalSettings canonical_settings(const T& settings) {
  T copy = settings;
  return detail::canonical_settings([&](FieldVisitor& v) { Schema<T>::describe(v, copy); });
}

}  // namespace flowslide
