#pragma once
#include "mpm/grid/points.hpp"

#include <array>
#include <limits>

/// An open edge: points that pass it leave the computation. docs/theory/mpm.md, section Outlet
namespace flowslide::mpm {

/// Where points may be; without bounds nothing leaves.
template <int Dim>
struct Outlet {
  std::array<double, Dim> low, high;  ///< [m]
  Outlet() {
    low.fill(-std::numeric_limits<double>::infinity());
    high.fill(std::numeric_limits<double>::infinity());
  }
};

template <int Dim>
bool any_beyond(const Outlet<Dim>& outlet, const Points<Dim>& points);

/// Moves the points beyond the outlet to the end of `gone`, as they are; those that stay keep their
/// order. Points that are not finite stay, for the checks of the run to name them.
template <int Dim>
void let_out(const Outlet<Dim>& outlet, Points<Dim>& points, Points<Dim>& gone);

}  // namespace flowslide::mpm
