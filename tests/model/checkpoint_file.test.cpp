#include "model/checkpoint_file.hpp"

#include "core/check.hpp"
#include "tests/model/scratch.hpp"

#include <sys/stat.h>

#include <catch2/catch.hpp>

using namespace flowslide;
using Catch::Matchers::Contains;

namespace {

struct Pair {
  std::int64_t a = 0;
  double b = 0.0;
};

void write(const std::filesystem::path& path) {
  CheckpointWriter out(path, 7);
  out.value(Pair{-3, 1.0 / 3.0});
  out.array(std::vector<double>{1.0, 2.0, 5.0});
  out.finish();
}

std::string refusal(const std::filesystem::path& path, std::uint64_t fields = 7) {
  try {
    CheckpointReader in(path, fields);
    Pair pair;
    std::vector<double> array;
    in.value(pair);
    in.array(array);
    in.finish();
  } catch (const FileError& e) {
    return e.what();
  }
  return "(none)";
}

}  // namespace

TEST_CASE("Checkpoints take a hundredth of the time at most, however slow the disk", "[model]") {
  CHECK(checkpoint_interval(0.02) == kCheckpointSeconds);  // 50 MB on a common disk
  const double slow = checkpoint_interval(3.0);
  CHECK(3.0 / slow <= kCheckpointShare);
  CHECK(slow < 400.0);  // and are not given up
}

TEST_CASE("a checkpoint comes back to the bit") {
  const Scratch folder;
  write(folder / "c");
  CHECK(folder.entries() == 1);
  CheckpointReader in(folder / "c", 7);
  Pair pair;
  std::vector<double> array{9.0};
  in.value(pair);
  in.array(array);
  in.finish();
  CHECK(pair.a == -3);
  CHECK(pair.b == 1.0 / 3.0);
  CHECK(array == std::vector<double>{1.0, 2.0, 5.0});
}

TEST_CASE("every flipped byte and every lost end of a checkpoint is found") {
  const Scratch folder;
  write(folder / "c");
  const std::string good = bytes_of(folder / "c");
  REQUIRE(refusal(folder / "c") == "(none)");
  for (std::size_t i = 0; i < good.size(); ++i) {
    std::string bad = good;
    bad[i] = static_cast<char>(bad[i] ^ 1);
    put_bytes(folder / "bad", bad);
    REQUIRE_THAT(refusal(folder / "bad"), Contains("checksum"));
    put_bytes(folder / "bad", good.substr(0, i));
    REQUIRE_THAT(refusal(folder / "bad"), Contains("cut off"));
  }
  put_bytes(folder / "bad", good + "x");
  CHECK_THAT(refusal(folder / "bad"), Contains("checksum") && Contains("delete it"));
}

TEST_CASE("a checkpoint with other fields is refused") {
  const Scratch folder;
  write(folder / "c");
  CHECK_THAT(refusal(folder / "c", 8), Contains("another version"));
  {
    CheckpointWriter out(folder / "more", 7);
    out.value(Pair{});
    out.array(std::vector<double>{1.0});
    out.value(1);
    out.finish();
  }
  CHECK_THAT(refusal(folder / "more"), Contains("more fields"));
  {
    CheckpointWriter out(folder / "less", 7);
    out.value(Pair{});
    out.value(std::uint64_t{1} << 61);  // an array that is not there
    out.finish();
  }
  CHECK_THAT(refusal(folder / "less"), Contains("ends within a field"));
}

TEST_CASE("a checkpoint that is not finished leaves the former one, and nothing else") {
  const Scratch folder;
  write(folder / "c");
  { CheckpointWriter(folder / "c", 9).value(1); }
  CHECK(refusal(folder / "c") == "(none)");
  CHECK(folder.entries() == 1);
}

TEST_CASE("what a killed writer left goes when the checkpoint is looked for") {
  const Scratch folder;
  write(folder / "c");
  put_bytes(folder / ".c.0123456789abcdef.partial", "half");
  CHECK(find_checkpoint(folder / "c"));
  CHECK(folder.entries() == 1);
  remove_checkpoint(folder / "c");
  CHECK_FALSE(find_checkpoint(folder / "c"));
}

TEST_CASE("a checkpoint that is no file is refused at once") {
  const Scratch folder;
  REQUIRE(::mkfifo((folder / "c").c_str(), 0600) == 0);
  CHECK(find_checkpoint(folder / "c"));
  CHECK_THAT(refusal(folder / "c"), Contains("a pipe or a device"));
}
