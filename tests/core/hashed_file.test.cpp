#include "core/hashed_file.hpp"

#include "core/check.hpp"
#include "core/hash.hpp"
#include "tests/support/scratch.hpp"

#include <chrono>
#include <sys/stat.h>
#include <thread>

#include <catch2/catch.hpp>

using namespace flowslide;
namespace fs = std::filesystem;

namespace {

/// Longer than a tick of the clock by which file systems date their changes.
void wait_a_tick() { std::this_thread::sleep_for(std::chrono::milliseconds(20)); }

}  // namespace

TEST_CASE("a file that stays is the same, one that is written and restored is not") {
  const Scratch scratch;
  const fs::path path = scratch.write("a.txt", "one");
  const HashedFile file = hash_file(path);
  CHECK(file.sha256 == sha256("one"));
  CHECK(file.state.size == 3);
  CHECK_NOTHROW(expect_unchanged(file));
  wait_a_tick();
  const auto time = fs::last_write_time(path);
  SECTION("written") { scratch.write("a.txt", "two"); }
  SECTION("written and restored, with its time") {
    scratch.write("a.txt", "two");
    scratch.write("a.txt", "one");
    fs::last_write_time(path, time);
  }
  SECTION("moved away and back, with another in its place meanwhile") {
    fs::rename(path, scratch / "kept");
    scratch.write("a.txt", "two");
    fs::rename(scratch / "kept", path);
  }
  SECTION("gone") { fs::remove(path); }
  CHECK_THROWS_AS(expect_same_state(file), FileError);
  CHECK_THROWS_WITH(expect_unchanged(file), Catch::Contains("a.txt"));
}

TEST_CASE("what has no end is not hashed") {
  const Scratch scratch;
  REQUIRE(::mkfifo((scratch / "pipe").c_str(), 0600) == 0);
  for (const fs::path& path : {scratch / "pipe", fs::path("/dev/zero"), scratch.path()}) {
    CHECK_THROWS_AS(hash_file(path), FileError);
  }
  CHECK_THROWS_WITH(hash_file(scratch / "none"), Catch::Contains("No such file"));
}

TEST_CASE("hashing can be stopped") {
  const Scratch scratch;
  const fs::path path = scratch.write("a.txt", std::string(300'000, 'x'));
  int blocks = 0;
  CHECK_THROWS_AS(hash_file(path,
                            [&] {
                              if (++blocks == 2) throw Interrupted("stopped");
                            }),
                  Interrupted);
  CHECK(blocks == 2);
}
