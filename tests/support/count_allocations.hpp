#pragma once
#include <atomic>
#include <cerrno>
#include <cstdlib>

/// Counts requests for memory of a whole program, Eigen's and those of `new` among them. Defines
/// malloc and its kin in terms of what the C library calls them by itself, so that exactly one file
/// of a program may include it. The sanitizers have an allocator of their own: with them nothing is
/// counted.
#ifndef __has_feature  // clang's, where g++ defines names
#define __has_feature(x) 0
#endif
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__) || \
    __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define FLOWSLIDE_COUNTS_ALLOCATIONS 0
#else
#define FLOWSLIDE_COUNTS_ALLOCATIONS 1
#endif

namespace flowslide::test {
inline std::atomic<long> allocations{0};
}

#if FLOWSLIDE_COUNTS_ALLOCATIONS
extern "C" {
void* __libc_malloc(std::size_t size);
void* __libc_calloc(std::size_t count, std::size_t size);
void* __libc_realloc(void* p, std::size_t size);
void* __libc_memalign(std::size_t alignment, std::size_t size);

void* malloc(std::size_t size) noexcept {
  ++flowslide::test::allocations;
  return __libc_malloc(size);
}
void* calloc(std::size_t count, std::size_t size) noexcept {
  ++flowslide::test::allocations;
  return __libc_calloc(count, size);
}
void* realloc(void* p, std::size_t size) noexcept {
  ++flowslide::test::allocations;
  return __libc_realloc(p, size);
}
void* aligned_alloc(std::size_t alignment, std::size_t size) noexcept {
  ++flowslide::test::allocations;
  return __libc_memalign(alignment, size);
}
int posix_memalign(void** p, std::size_t alignment, std::size_t size) noexcept {
  ++flowslide::test::allocations;
  *p = __libc_memalign(alignment, size);
  return *p ? 0 : ENOMEM;
}
}
#endif
