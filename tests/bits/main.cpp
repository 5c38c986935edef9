#include "tests/bits/scenes.hpp"

#include <cstdlib>
#include <exception>

#include <fmt/format.h>

/// bits THREADS: prints one line for each thing computed, its name and a digest of its numbers. The
/// lines are the same on every processor and for any number of threads; those of the last change of
/// results stand in fixtures/bits/digests.txt.
int main(int count, char** arguments) {
  using namespace flowslide::same_bits;
  const int threads = count > 1 ? std::atoi(arguments[1]) : 1;
  if (threads < 1) {
    fmt::print(stderr, "usage: bits THREADS\n");
    return 2;
  }
  try {
    for (const Lines& part :
         {functions(), motions(), laws(threads), schemes(threads), chain(threads)})
      for (const Line& line : part) fmt::print("{:<40} {}\n", line.name, line.digest);
  } catch (const std::exception& e) {
    fmt::print(stderr, "error: {}\n", e.what());
    return 3;
  }
  return 0;
}
