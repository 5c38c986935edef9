#pragma once
#include "mpm/grid/shares.hpp"

#include <array>
#include <atomic>

/// Sweeps over tiles inside a parallel region.
namespace flowslide::mpm {

/// Calls f(tile) for every tile of a group once; called by every thread of a parallel region, ends
/// with a barrier. The reset after it may meet a thread that is in the next sweep already: that one
/// either finds nothing left here or takes a tile rightly.
template <class F>
void take_turns(Group& group, int thread, F&& f) {
  std::vector<Share>& shares = group.shares;
  const auto count = static_cast<int>(shares.size());
  for (int k = 0; k < count; ++k) {
    Share& share = shares[static_cast<std::size_t>((thread + k) % count)];
    const std::atomic_ref<std::int32_t> next(share.next);
    for (;;) {
      const std::int32_t i = next.fetch_add(1, std::memory_order_relaxed);
      if (i >= share.last) break;
      f(group.tiles[i]);
    }
  }
#pragma omp barrier
  Share& own = shares[static_cast<std::size_t>(thread)];
  std::atomic_ref<std::int32_t>(own.next).store(own.first, std::memory_order_relaxed);
}

/// The same for several groups, one after another.
template <class F>
void take_turns(std::array<Group, 2>& groups, int thread, F&& f) {
  for (Group& group : groups) take_turns(group, thread, f);
}

}  // namespace flowslide::mpm
