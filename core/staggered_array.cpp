#include "core/staggered_array.hpp"

#include <atomic>
#include <cstdlib>
#include <cstring>
#include <sys/mman.h>

namespace flowslide {
namespace {

constexpr std::size_t kLine = 64, kPage = 4096, kHugePage = std::size_t{1} << 21;
constexpr std::size_t kStaggeredFrom = std::size_t{1} << 14;
// 73 lines: starts of consecutive arrays fall on lines 0, 9, 18, ... of a page of 64 lines, so the
// first-level cache is used evenly, and 26 arrays spread over the 2048 sets of the second level.
constexpr std::size_t kStride = 73 * kLine, kPeriod = 32 * kStride;

}  // namespace

void* allocate_staggered(std::size_t bytes) {
  static std::atomic<std::size_t> count{0};
  const std::size_t start =
      kLine + (bytes < kStaggeredFrom ? 0 : count.fetch_add(1) * kStride % kPeriod);
  const std::size_t page = bytes < kHugePage ? kPage : kHugePage;
  const std::size_t alignment = bytes < kStaggeredFrom ? kLine : page;
  const std::size_t size = (start + bytes + alignment - 1) / alignment * alignment;
  void* memory = std::aligned_alloc(alignment, size);
  if (memory == nullptr) throw std::bad_alloc();
  // Only advice: without huge pages the sweep is slower, nothing else.
  if (page == kHugePage) madvise(memory, size, MADV_HUGEPAGE);
  char* at = static_cast<char*>(memory) + start;
  std::memcpy(at - sizeof memory, &memory, sizeof memory);
  return at;
}

void free_staggered(void* at) noexcept {
  void* memory = nullptr;
  std::memcpy(&memory, static_cast<char*>(at) - sizeof memory, sizeof memory);
  std::free(memory);
}

}  // namespace flowslide
