#include "model/chunk_filters.hpp"

#include "model/hdf5_handle.hpp"
#include "tests/model/scratch.hpp"

#include <cmath>
#include <cstring>
#include <string_view>
#include <vector>
#include <zlib.h>

#include <catch2/catch.hpp>

using namespace flowslide;

namespace {

std::uint32_t checksum_of(std::string_view text) {
  return fletcher32({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
}

/// Values as they come from a flow, some runs among them.
std::vector<double> values_of(std::size_t count) {
  std::vector<double> values(count);
  for (std::size_t i = 0; i < count; ++i) values[i] = i % 3 == 2 ? 0.0 : std::sin(double(i));
  return values;
}

}  // namespace

TEST_CASE("Checksums of chunks are Fletcher's", "[model]") {
  // By hand: words 0x6162, 0x6300: sums 0xc462, and 0x6162 + 0xc462 = 0x125c4, folded 0x25c5.
  CHECK(checksum_of("abc") == 0x25c5c462u);
  CHECK(checksum_of("") == 0u);
  // 65535 counts as itself, not as 0.
  CHECK(checksum_of("\xff\xff") == 0xffffffffu);
  // A word in another place is another sum, which plain addition would not see.
  CHECK(checksum_of("abcd") != checksum_of("cdab"));
}

TEST_CASE("What HDF5 reads of a chunk is what was given", "[model]") {
  const Scratch scratch;
  start_hdf5();
  const std::size_t count = 1000, capacity = GENERATE(1000, 1003);
  const std::vector<double> values = values_of(count);
  const auto path = (scratch / "chunk.h5").string();
  ChunkFilters filters;
  for (int damaged = 0; damaged < 2; ++damaged) {
    const Hdf5Handle file(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT),
                          &H5Fclose);
    const hsize_t chunk = capacity, extent = count;
    const Hdf5Handle space(H5Screate_simple(1, &extent, nullptr), &H5Sclose);
    const Hdf5Handle layout(H5Pcreate(H5P_DATASET_CREATE), &H5Pclose);
    REQUIRE((H5Pset_chunk(layout, 1, &chunk) >= 0 && H5Pset_shuffle(layout) >= 0 &&
             H5Pset_deflate(layout, 1) >= 0 && H5Pset_fletcher32(layout) >= 0));
    // A fixed dataset may not have chunks larger than itself.
    const hsize_t most = H5S_UNLIMITED;
    const Hdf5Handle open_end(H5Screate_simple(1, &extent, &most), &H5Sclose);
    const Hdf5Handle dataset(
        H5Dcreate2(file, "x", H5T_IEEE_F64LE, open_end, H5P_DEFAULT, layout, H5P_DEFAULT),
        &H5Dclose);
    const auto packed = filters.apply(values.data(), count, capacity, sizeof(double));
    std::vector<std::uint8_t> bytes(packed.begin(), packed.end());
    if (damaged == 1) bytes[bytes.size() / 2] ^= 1;
    const hsize_t at = 0;
    REQUIRE(H5Dwrite_chunk(dataset, H5P_DEFAULT, 0, &at, bytes.size(), bytes.data()) >= 0);
    std::vector<double> back(count);
    const bool read =
        H5Dread(dataset, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, back.data()) >= 0;
    CHECK(read == (damaged == 0));
    if (damaged == 0) CHECK(back == values);
  }
}

TEST_CASE("Filters can be used again, for chunks of any size", "[model]") {
  ChunkFilters filters;
  const std::vector<double> values = values_of(5000);
  const auto copy = [&](std::size_t count) {
    const auto packed = filters.apply(values.data(), count, count, sizeof(double));
    return std::vector<std::uint8_t>(packed.begin(), packed.end());
  };
  const auto first = copy(5000);
  CHECK(copy(10).size() < first.size());
  CHECK(copy(5000) == first);
  // The bytes of doubles: a third of them zeros, the rest noise.
  CHECK(first.size() < sizeof(double) * values.size() * 3 / 4);
}
