#pragma once
#include <cstdint>
#include <vector>

/// The work of a sweep dealt to threads. Each begins with the same tiles in every sweep, whose
/// points lie in its cache, and when done takes what others have not begun. Which thread does what
/// has no influence on results, since every tile writes to memory of its own. mpm/take_turns.hpp
namespace flowslide::mpm {

struct alignas(64) Share {
  std::int32_t first = 0, last = 0;  ///< into Group::tiles
  std::int32_t next = 0;             ///< not yet begun; changed atomically
};

/// Tiles that a sweep visits.
struct Group {
  std::vector<std::int32_t> tiles;
  std::vector<Share> shares;  ///< one per thread
};

/// Deals a group in runs of about equal weight, one run per share.
template <class Weight>
void deal(Group& group, Weight&& weight_of) {
  auto& shares = group.shares;
  const auto count = static_cast<std::int32_t>(group.tiles.size());
  const auto weight = [&](std::int32_t i) { return weight_of(group.tiles[i]); };
  double total = 0.0, given = 0.0;
  for (std::int32_t i = 0; i < count; ++i) total += weight(i);
  std::int32_t i = 0;
  for (std::size_t k = 0; k < shares.size(); ++k) {
    shares[k].first = shares[k].next = i;
    const double limit = total * double(k + 1) / double(shares.size());
    for (; i < count && (k + 1 == shares.size() || given + 0.5 * weight(i) < limit); ++i)
      given += weight(i);
    shares[k].last = i;
  }
}

}  // namespace flowslide::mpm
