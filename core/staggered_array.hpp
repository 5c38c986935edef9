#pragma once
#include <cstddef>
#include <new>
#include <vector>

/// Arrays for sweeps that read the same index of many of them at once. Two things slow such sweeps
/// that std::allocator leaves to chance: arrays of some hundred kilobytes and more all start at the
/// same place of a memory page, so that equal indices of all of them compete for the same few lines
/// of the caches, and with pages of 4 kB most accesses have to look up where their page is. Here
/// starts are staggered, and large arrays ask the system for pages of 2 MB.
namespace flowslide {

/// Memory of `bytes` > 0, aligned to 64. Throws std::bad_alloc.
[[nodiscard]] void* allocate_staggered(std::size_t bytes);
void free_staggered(void* memory) noexcept;

template <class T>
struct StaggeredAllocator {
  using value_type = T;
  StaggeredAllocator() = default;
  template <class U>
  StaggeredAllocator(const StaggeredAllocator<U>&) noexcept {}
  [[nodiscard]] T* allocate(std::size_t n) {
    if (n > static_cast<std::size_t>(-1) / 2 / sizeof(T)) throw std::bad_array_new_length();
    return static_cast<T*>(allocate_staggered(n * sizeof(T)));
  }
  void deallocate(T* at, std::size_t) noexcept { free_staggered(at); }
  friend bool operator==(StaggeredAllocator, StaggeredAllocator) { return true; }
};

template <class T>
using StaggeredArray = std::vector<T, StaggeredAllocator<T>>;

}  // namespace flowslide
