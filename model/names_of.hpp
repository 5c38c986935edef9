#pragma once
#include <string>
#include <vector>

namespace flowslide {

/// Names of the items for a message, "a, b" or "none".
template <class T>
std::string names_of(const std::vector<T>& items) {
  std::string text;
  for (const T& item : items) text += (text.empty() ? "" : ", ") + item.name;
  return text.empty() ? "none" : text;
}

}  // namespace flowslide
