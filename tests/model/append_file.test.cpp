#include "model/append_file.hpp"

#include "core/check.hpp"
#include "tests/model/scratch.hpp"

#include <array>

#include <catch2/catch.hpp>

using namespace flowslide;
using Catch::Matchers::Contains;

namespace {

using Record = std::array<double, 5>;
constexpr std::size_t kStep = sizeof(Record) + 64;

Record record(int k) { return {0.1 * k, 1.0, -2.0, 1.0 / 3.0, double(k)}; }

void write(const std::filesystem::path& path, int records) {
  AppendFile out(path, sizeof(Record), 0);
  for (int k = 0; k < records; ++k) out.append(record(k).data());
  out.sync();
}

std::string refusal(const std::filesystem::path& path, std::size_t keep) {
  try {
    AppendFile in(path, sizeof(Record), keep);
  } catch (const FileError& e) {
    return e.what();
  }
  return "(none)";
}

}  // namespace

TEST_CASE("records come back, and those behind the last that counts go") {
  const Scratch folder;
  write(folder / "f", 4);
  AppendFile again(folder / "f", sizeof(Record), 3);
  CHECK(again.size() == 3);
  CHECK(std::filesystem::file_size(folder / "f") == 3 * kStep);
  again.append(record(9).data());
  Record found{};
  again.read(3, found.data());
  CHECK(found == record(9));
  again.read(1, found.data());
  CHECK(found == record(1));
}

TEST_CASE("a changed byte anywhere in the records that count is noticed") {
  const Scratch folder;
  write(folder / "f", 3);
  const std::string good = bytes_of(folder / "f");
  REQUIRE(refusal(folder / "f", 3) == "(none)");
  for (std::size_t i = 0; i < good.size(); ++i) {
    std::string bad = good;
    bad[i] = static_cast<char>(bad[i] ^ 1);
    put_bytes(folder / "f", bad);
    REQUIRE_THAT(refusal(folder / "f", 3), Contains(fmt::format("record {} ", i / kStep)) &&
                                               Contains("delete the checkpoint"));
    put_bytes(folder / "f", bad);
    // What comes behind the checkpoint does not count: it is written again.
    REQUIRE((refusal(folder / "f", 2) == "(none)") == (i >= 2 * kStep));
  }
}

TEST_CASE("records in another order, or cut off, are refused") {
  const Scratch folder;
  write(folder / "f", 3);
  const std::string good = bytes_of(folder / "f");
  put_bytes(folder / "f", good.substr(kStep, kStep) + good.substr(0, kStep));
  CHECK_THAT(refusal(folder / "f", 2), Contains("record 0 "));
  put_bytes(folder / "f", good.substr(0, good.size() - 1));
  CHECK_THAT(refusal(folder / "f", 3), Contains("cut off"));
  CHECK(refusal(folder / "f", 2) == "(none)");
  CHECK_THAT(refusal(folder / "f", static_cast<std::size_t>(-1)), Contains("cut off"));
  CHECK_THAT(refusal(folder / "none", 1), Contains("No such file"));
}

TEST_CASE("a link is not followed") {
  const Scratch folder;
  put_bytes(folder / "victim", "keep");
  std::filesystem::create_symlink("victim", folder / "f");
  CHECK_THAT(refusal(folder / "f", 1), Contains("cannot be opened"));
  write(folder / "f", 1);
  CHECK(bytes_of(folder / "victim") == "keep");
  CHECK_FALSE(std::filesystem::is_symlink(folder / "f"));
}
