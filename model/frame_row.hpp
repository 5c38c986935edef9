#pragma once
#include <algorithm>
#include <cstddef>

/// Arrays of a frame as the doubles of one row of an append-only file.
namespace flowslide {

/// Doubles of one entry.
template <class Array>
constexpr std::size_t width_of(const Array&) {
  return sizeof(typename Array::value_type) / sizeof(double);
}

/// Copies an array to `to`; returns the place after it.
template <class Array>
double* put_row(const Array& array, double* to) {
  return std::copy_n(reinterpret_cast<const double*>(array.data()), array.size() * width_of(array),
                     to);
}

/// The inverse, for `entries` entries.
template <class Array>
const double* take_row(const double* from, std::size_t entries, Array& array) {
  array.resize(entries);
  const std::size_t n = entries * width_of(array);
  std::copy_n(from, n, reinterpret_cast<double*>(array.data()));
  return from + n;
}

}  // namespace flowslide
