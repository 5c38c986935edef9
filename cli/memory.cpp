#include <cerrno>
#include <cstddef>
#include <dlfcn.h>
#include <string_view>
#include <unistd.h>

/// Requests for memory, of the program and of all its libraries, pass through here: where there is
/// none, the program ends at once with the code of failed files. Left to themselves, HDF5, OpenSSL
/// and the runtime of OpenMP crash then, end with codes of their own, or go on and write wrong
/// bytes, and an exception must not leave a parallel region. Ending anywhere is safe: nothing is
/// under its final name before it is complete, and the next run takes away what is not.
namespace {

constexpr int kExitCode = 4;
constexpr std::string_view kMessage =
    "\nerror: out of memory (the model is larger than this machine can hold). Use a coarser cell "
    "or spacing, or a larger machine.\n";

/// Nothing on the way out may ask for memory.
void* checked(void* memory, std::size_t size) {
  if (memory || size == 0) return memory;
  [[maybe_unused]] const auto told = ::write(STDERR_FILENO, kMessage.data(), kMessage.size());
  ::_exit(kExitCode);
}

template <class F>
F* next(const char* name) {
  return reinterpret_cast<F*>(::dlsym(RTLD_NEXT, name));
}

}  // namespace

extern "C" {

void* malloc(std::size_t size) {
  static auto* const real = next<void*(std::size_t)>("malloc");
  return checked(real(size), size);
}

void* calloc(std::size_t count, std::size_t size) {
  static auto* const real = next<void*(std::size_t, std::size_t)>("calloc");
  return checked(real(count, size), count != 0 ? size : 0);
}

void* realloc(void* old, std::size_t size) {
  static auto* const real = next<void*(void*, std::size_t)>("realloc");
  return checked(real(old, size), size);
}

void* aligned_alloc(std::size_t alignment, std::size_t size) {
  static auto* const real = next<void*(std::size_t, std::size_t)>("aligned_alloc");
  return checked(real(alignment, size), size);
}

int posix_memalign(void** memory, std::size_t alignment, std::size_t size) {
  static auto* const real = next<int(void**, std::size_t, std::size_t)>("posix_memalign");
  const int reason = real(memory, alignment, size);
  if (reason == ENOMEM) checked(nullptr, size);
  return reason;
}
}
