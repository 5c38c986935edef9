#include "tests/fuzz/targets.hpp"

#include <cstddef>
#include <cstdint>

/// What libFuzzer calls; FLOWSLIDE_FUZZ_TARGET is a function of targets.hpp.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size);

int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  flowslide::fuzz::FLOWSLIDE_FUZZ_TARGET({reinterpret_cast<const char*>(bytes), size});
  return 0;
}
