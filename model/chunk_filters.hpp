#pragma once
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

/// Chunks of HDF5 datasets as its own filters would leave them. Private to this module.
namespace flowslide {

/// Shuffle, deflate and Fletcher-32, in this order (HDF5 File Format Specification, version 3,
/// IV.A.2.l). The filter of the library looks for repeats of any length; in the shuffled bytes of a
/// flow there are hardly any but runs, and looking for those alone takes half the time for 6 % more
/// bytes. Every reader of HDF5 takes either.
class ChunkFilters {
 public:
  ChunkFilters();
  ~ChunkFilters();
  ChunkFilters(const ChunkFilters&) = delete;
  ChunkFilters& operator=(const ChunkFilters&) = delete;

  /// What to write for a chunk of `capacity` values of `size` bytes each, of which `data` gives the
  /// first `count` and the rest is 0. Valid until the next call. Throws std::bad_alloc.
  std::span<const std::uint8_t> apply(const void* data, std::size_t count, std::size_t capacity,
                                      std::size_t size);

 private:
  struct Deflate;
  std::unique_ptr<Deflate> deflate_;
  std::vector<std::uint8_t> shuffled_, packed_;
};

/// The checksum that HDF5 keeps behind a chunk: Fletcher's sums of its bytes as big-endian words of
/// 16 bits, modulo 65535; a last odd byte counts as the upper half of a word.
std::uint32_t fletcher32(std::span<const std::uint8_t> bytes);

}  // namespace flowslide
