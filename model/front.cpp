#include "model/front.hpp"

#include <algorithm>
#include <limits>

namespace flowslide {
namespace {

/// A total order but for points that are equal in place and mass, which may change places without
/// any number moving: the sums from the front do not hang on the order in which the points come,
/// nor on how a library sorts. (Places that are not numbers have no order; they are refused
/// before.)
bool farther(const Place& a, const Place& b) {
  return a.at != b.at ? a.at > b.at : a.mass > b.mass;
}

}  // namespace

void places_beyond(std::span<Place> points, std::span<const double> shares, std::span<double> out) {
  std::fill(out.begin(), out.end(), std::numeric_limits<double>::quiet_NaN());
  double total = 0.0;
  for (const Place& p : points) total += p.mass;
  // Only the farthest points matter: they are sorted by and by, an eighth of the rest at a time.
  std::size_t sorted = 0, share = 0;
  double beyond = 0.0;
  while (sorted < points.size() && share < shares.size()) {
    const std::span<Place> rest = points.subspan(sorted);
    const std::size_t next = std::min(rest.size(), rest.size() / 8 + 64);
    if (next < rest.size())
      std::nth_element(rest.begin(), rest.begin() + static_cast<std::ptrdiff_t>(next), rest.end(),
                       farther);
    std::sort(rest.begin(), rest.begin() + static_cast<std::ptrdiff_t>(next), farther);
    for (const Place& p : rest.first(next)) {
      beyond += p.mass;
      while (share < shares.size() && beyond > shares[share] * total) out[share++] = p.at;
    }
    sorted += next;
  }
}

Fronts fronts(std::span<Place> points) {
  if (points.empty()) return {};
  std::array<double, kFrontShares.size()> at{};
  places_beyond(points, kFrontShares, at);
  const std::size_t rank = std::min(kFrontRank, points.size()) - 1;
  std::nth_element(points.begin(), points.begin() + static_cast<std::ptrdiff_t>(rank), points.end(),
                   farther);
  return {points[rank].at, at[0], at[1], at[2], at[3]};
}

double height(std::span<Place> points) {
  if (points.empty()) return 0.0;
  double top = 0.0;
  places_beyond(points, {&kHeightShare, 1}, {&top, 1});
  return top;
}

}  // namespace flowslide
