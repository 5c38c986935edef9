#pragma once
#include "mpm/shares.hpp"

#include <atomic>

/// Sweeps over shared items inside a parallel region.
namespace flowslide::mpm {

/// Calls f(i) for every item once; called by every thread of a parallel region, ends with a
/// barrier. The reset after it may meet a thread that is in the next sweep already: that one either
/// finds nothing left here or takes an item rightly.
template <class F>
void take_turns(std::vector<Share>& shares, int thread, F&& f) {
  const auto count = static_cast<int>(shares.size());
  for (int k = 0; k < count; ++k) {
    Share& share = shares[static_cast<std::size_t>((thread + k) % count)];
    const std::atomic_ref<std::int32_t> next(share.next);
    for (;;) {
      const std::int32_t i = next.fetch_add(1, std::memory_order_relaxed);
      if (i >= share.last) break;
      f(i);
    }
  }
#pragma omp barrier
  Share& own = shares[static_cast<std::size_t>(thread)];
  std::atomic_ref<std::int32_t>(own.next).store(own.first, std::memory_order_relaxed);
}

}  // namespace flowslide::mpm
