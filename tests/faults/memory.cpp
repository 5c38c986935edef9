#include "tests/faults/faults.hpp"

#include <algorithm>
#include <cerrno>
#include <cstddef>

/// Memory, from the first line of main() to its last. Runs ask for memory hundreds of thousands of
/// times from a few thousand places: without a fault to make, the first call from each place is
/// written down.
extern "C" {
void* __libc_malloc(std::size_t);
void* __libc_calloc(std::size_t, std::size_t);
void* __libc_realloc(void*, std::size_t);
void* __libc_memalign(std::size_t, std::size_t);
}

namespace faults {
namespace {

constexpr std::size_t kSlots = 1u << 17;
unsigned places[kSlots];

/// The call that strike() has just counted, if it is the first from its place.
void note_first_from_place() {
  const unsigned place = std::max(1u, place_of_call());
  std::size_t at = place % kSlots;
  while (places[at] != 0 && places[at] != place) at = (at + 1) % kSlots;
  if (places[at] != 0) return;
  const unsigned point = record->points++;
  if (point >= kSlots / 2) return;
  places[at] = place;
  record->list[point] = record->count;
  record->place[point] = place;
}

thread_local bool inside = false;  ///< the look for callers may ask for memory itself

/// True if this request is to be refused.
bool refused() {
  if (!armed || !plan.memory || inside) return false;
  inside = true;
  const bool refuse = strike(Call::memory, ENOMEM) != 0;
  if (plan.number == 0) note_first_from_place();
  inside = false;
  if (refuse) errno = ENOMEM;
  return refuse;
}

}  // namespace
}  // namespace faults

extern "C" {

void* malloc(std::size_t size) { return faults::refused() ? nullptr : __libc_malloc(size); }

void* calloc(std::size_t count, std::size_t size) {
  return faults::refused() ? nullptr : __libc_calloc(count, size);
}

void* realloc(void* old, std::size_t size) {
  return faults::refused() ? nullptr : __libc_realloc(old, size);
}

void* memalign(std::size_t alignment, std::size_t size) {
  return faults::refused() ? nullptr : __libc_memalign(alignment, size);
}

void* aligned_alloc(std::size_t alignment, std::size_t size) { return memalign(alignment, size); }

int posix_memalign(void** out, std::size_t alignment, std::size_t size) {
  void* const made = memalign(alignment, size);
  if (!made) return ENOMEM;
  *out = made;
  return 0;
}
}
