#include "tests/faults/faults.hpp"

#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <unwind.h>

/// Memory, from the first line of main() to its last. Runs ask for memory hundreds of thousands of
/// times from a few thousand places: without a fault to make, the first call from each place is
/// written down, a place being the addresses of the innermost callers.
extern "C" {
void* __libc_malloc(std::size_t);
void* __libc_calloc(std::size_t, std::size_t);
void* __libc_realloc(void*, std::size_t);
void* __libc_memalign(std::size_t, std::size_t);
}

namespace faults {
namespace {

constexpr int kDepth = 12;  ///< callers that make a place
constexpr std::size_t kSlots = 1u << 17;

std::uint64_t places[kSlots];
thread_local bool inside = false;  ///< the look for callers may ask for memory itself

struct Walk {
  int depth = 0;
  std::uint64_t hash = 1469598103934665603u;
};

_Unwind_Reason_Code visit(_Unwind_Context* context, void* data) {
  Walk& walk = *static_cast<Walk*>(data);
  walk.hash = (walk.hash ^ _Unwind_GetIP(context)) * 1099511628211u;
  return ++walk.depth < kDepth ? _URC_NO_REASON : _URC_END_OF_STACK;
}

void note_place(unsigned number) {
  Walk walk;
  _Unwind_Backtrace(&visit, &walk);
  std::size_t at = walk.hash % kSlots;
  while (places[at] != 0 && places[at] != walk.hash) at = (at + 1) % kSlots;
  if (places[at] != 0) return;
  const unsigned point = record->points++;
  if (point >= kSlots / 2) return;
  places[at] = walk.hash;
  record->list[point] = number;
}

/// True if this request is to be refused.
bool refused() {
  if (!armed || !plan.memory || inside) return false;
  inside = true;
  const bool refuse = strike(Call::memory, ENOMEM) != 0;
  if (plan.number == 0) note_place(record->count);
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
