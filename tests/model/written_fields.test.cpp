#include "model/written_fields.hpp"

#include "core/check.hpp"
#include "tests/model/scratch.hpp"

#include <catch2/catch.hpp>

using namespace flowslide;
using Catch::Matchers::Contains;

namespace {

constexpr FieldLabel kMetres{.unit = "m"};
const std::vector<std::array<double, 2>> kPairs{{1.0, 2.0}, {3.0, 4.0}, {5.0, 6.0}};
const std::vector<std::int32_t> kRow{7, 8, 9};

void write(const std::filesystem::path& path) {
  FieldWriter out(path, "some", 1);
  out.write("pairs", kPairs, kMetres);
  for (int k = 0; k < 4; ++k) out.append("rows", kRow, kMetres);
  out.write("none", std::vector<double>{}, kMetres);
  out.write_texts("words", {"one", "three"});
  out.finish();
}

/// The message with which a file is refused that should hold what is added here.
template <class Add>
std::string refusal(const std::filesystem::path& path, Add&& add) {
  WrittenFields fields;
  add(fields);
  try {
    fields.compare(path, "shown.h5");
  } catch (const FileError& e) {
    return e.what();
  }
  return "(none)";
}

}  // namespace

TEST_CASE("a file is compared with what was written, whatever its checksums say") {
  const Scratch folder;
  write(folder / "f.h5");
  const auto good = [](WrittenFields& f) {
    f.add("pairs", Scalar::f64, 0, 3, {2}, kPairs.data());
    for (int k = 0; k < 4; ++k) f.add("rows", Scalar::i32, 0, 1, {3}, kRow.data());
    f.add("none", Scalar::f64, 0, 0, {}, nullptr);
    f.add("words", Scalar::u8, 5, 2, {}, "one\0\0three");
  };
  CHECK(refusal(folder / "f.h5", good) == "(none)");
  const auto with = [&](auto add) { return refusal(folder / "f.h5", add); };
  auto other = kPairs;
  other[2][1] = 6.0 + 1e-15;
  CHECK_THAT(with([&](WrittenFields& f) { f.add("pairs", Scalar::f64, 0, 3, {2}, other.data()); }),
             Contains("shown.h5") && Contains("'pairs'") && Contains("not what was written"));
  CHECK_THAT(with([&](WrittenFields& f) { f.add("pairs", Scalar::f64, 0, 2, {2}, kPairs.data()); }),
             Contains("not what was written"));
  CHECK_THAT(with([&](WrittenFields& f) { f.add("rows", Scalar::i32, 0, 1, {3}, kRow.data()); }),
             Contains("not what was written"));
  CHECK_THAT(with([&](WrittenFields& f) { f.add("gone", Scalar::i32, 0, 1, {3}, kRow.data()); }),
             Contains("'gone'"));
  put_bytes(folder / "cut.h5", bytes_of(folder / "f.h5").substr(0, 1000));
  CHECK_THAT(refusal(folder / "cut.h5", good), Contains("cannot be read back"));
}

TEST_CASE("pieces of a dataset that were never written are missed, not read as zeros") {
  const Scratch folder;
  write(folder / "f.h5");
  const auto rows = [&] {
    return FieldReader(folder / "f.h5", "some", 1).read_row<std::int32_t>("rows", 3, 3);
  };
  CHECK(rows() == kRow);
  const hid_t file = H5Fopen((folder / "f.h5").c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
  const hid_t dataset = H5Dopen2(file, "rows", H5P_DEFAULT);
  const hsize_t longer[] = {5, 3};
  REQUIRE(H5Dset_extent(dataset, longer) >= 0);
  H5Dclose(dataset);
  REQUIRE(H5Fclose(file) >= 0);
  CHECK_THROWS_AS(rows(), FileError);
  CHECK_THROWS_WITH(rows(), Contains("4 of 5 pieces"));
}
