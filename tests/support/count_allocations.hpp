#pragma once
#include <atomic>
#include <cstdlib>
#include <new>

/// Counts every allocation of the executable, whose one source that includes this replaces all forms
/// of `new` that the library calls: a sanitizer takes one left out for memory of another kind.
namespace {
std::atomic<long> allocations{0};

void* count_and_allocate(std::size_t size) noexcept {
  ++allocations;
  return std::malloc(size ? size : 1);
}
}  // namespace

[[gnu::noinline]] void* operator new(std::size_t size) {
  if (void* p = count_and_allocate(size)) return p;
  throw std::bad_alloc();
}
[[gnu::noinline]] void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  return count_and_allocate(size);
}
[[gnu::noinline]] void* operator new(std::size_t size, std::align_val_t align) {
  ++allocations;
  const auto a = static_cast<std::size_t>(align);
  if (void* p = std::aligned_alloc(a, (size + a - 1) / a * a)) return p;
  throw std::bad_alloc();
}
[[gnu::noinline]] void operator delete(void* p) noexcept { std::free(p); }
[[gnu::noinline]] void operator delete(void* p, std::size_t) noexcept { std::free(p); }
[[gnu::noinline]] void operator delete(void* p, const std::nothrow_t&) noexcept { std::free(p); }
[[gnu::noinline]] void operator delete(void* p, std::align_val_t) noexcept { std::free(p); }
[[gnu::noinline]] void operator delete(void* p, std::size_t, std::align_val_t) noexcept {
  std::free(p);
}
