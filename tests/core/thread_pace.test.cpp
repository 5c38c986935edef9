#include "core/thread_pace.hpp"

#include <thread>

#include <catch2/catch.hpp>

using flowslide::ThreadChoice;
using flowslide::ThreadPace;

namespace {

/// Batches of a program whose rate with n threads is `rate(n)`; the share of batches with `wanted`.
template <class Rate>
double share_with(ThreadChoice& choice, int wanted, int batches, bool disturbed, Rate&& rate) {
  int with = 0;
  for (int i = 0; i < batches; ++i) {
    with += choice.threads() == wanted;
    choice.look(rate(choice.threads()), disturbed);
  }
  return double(with) / batches;
}

double quiet(int threads) { return threads; }
/// As measured with one busy program beside two threads on two cores.
double waiting(int threads) { return threads == 1 ? 0.95 : 0.5; }

}  // namespace

TEST_CASE("Undisturbed threads are never changed", "[core]") {
  ThreadChoice choice(4);
  CHECK(share_with(choice, 4, 1000, false, quiet) == 1.0);
}

TEST_CASE("Threads that wait for each other become fewer, and more again", "[core]") {
  ThreadChoice choice(2);
  CHECK(share_with(choice, 1, 1000, true, waiting) > 0.9);
  CHECK(share_with(choice, 2, 1000, false, quiet) > 0.9);
}

TEST_CASE("Disturbed threads that are faster together stay", "[core]") {
  ThreadChoice choice(8);
  // Slower than alone on the machine, but the more the better.
  CHECK(share_with(choice, 8, 1000, true, [](int n) { return 0.4 * n; }) > 0.95);
}

TEST_CASE("The best number between all and one is found and kept", "[core]") {
  ThreadChoice choice(16);
  const auto four_cores_free = [](int n) { return n <= 4 ? n : 16.0 / n; };
  CHECK(share_with(choice, 4, 2000, true, four_cores_free) > 0.8);
}

TEST_CASE("A pace of one thread stays with it", "[core]") {
  ThreadPace pace(1);
  CHECK(pace.after_step() == 1);
  ThreadPace two(2);
  std::this_thread::sleep_for(std::chrono::milliseconds(120));
  CHECK(two.after_step() == 2);
}
