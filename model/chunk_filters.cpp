#include "model/chunk_filters.hpp"

#include "core/check.hpp"

#include <algorithm>
#include <limits>
#include <new>
#include <zlib.h>

namespace flowslide {
namespace {

constexpr int kDeflateLevel = 1, kWindowBits = 15, kMemoryLevel = 8;
constexpr std::size_t kChecksumBytes = 4;

/// The first bytes of all values, then their second ones, and so on.
void shuffle(const std::uint8_t* data, std::size_t count, std::size_t capacity, std::size_t size,
             std::uint8_t* out) {
  for (std::size_t byte = 0; byte < size; ++byte) {
    std::uint8_t* lane = out + byte * capacity;
    for (std::size_t i = 0; i < count; ++i) lane[i] = data[size * i + byte];
    std::fill(lane + count, lane + capacity, std::uint8_t{0});
  }
}

/// Modulo 65535, with 65535 in place of 0 but for 0 itself.
std::uint64_t folded(std::uint64_t sum) {
  while (sum > 0xffff) sum = (sum & 0xffff) + (sum >> 16);
  return sum;
}

}  // namespace

struct ChunkFilters::Deflate {
  z_stream stream{};
  Deflate() {
    if (deflateInit2(&stream, kDeflateLevel, Z_DEFLATED, kWindowBits, kMemoryLevel, Z_RLE) != Z_OK)
      throw std::bad_alloc();  // the only cause that zlib leaves
  }
  ~Deflate() { deflateEnd(&stream); }
  Deflate(const Deflate&) = delete;
  Deflate& operator=(const Deflate&) = delete;
};

ChunkFilters::ChunkFilters() : deflate_(std::make_unique<Deflate>()) {}
ChunkFilters::~ChunkFilters() = default;

std::span<const std::uint8_t> ChunkFilters::apply(const void* data, std::size_t count,
                                                  std::size_t capacity, std::size_t size) {
  FLOWSLIDE_EXPECT(count <= capacity && capacity <= std::numeric_limits<uInt>::max() / size);
  shuffled_.resize(capacity * size);
  shuffle(static_cast<const std::uint8_t*>(data), count, capacity, size, shuffled_.data());
  z_stream& z = deflate_->stream;
  packed_.resize(deflateBound(&z, shuffled_.size()) + kChecksumBytes);
  z.next_in = shuffled_.data();
  z.avail_in = static_cast<uInt>(shuffled_.size());
  z.next_out = packed_.data();
  z.avail_out = static_cast<uInt>(packed_.size() - kChecksumBytes);
  const bool whole = ::deflate(&z, Z_FINISH) == Z_STREAM_END;
  const std::size_t bytes = z.total_out;
  if (deflateReset(&z) != Z_OK || !whole) throw std::bad_alloc();
  const std::uint32_t sum = fletcher32({packed_.data(), bytes});
  for (std::size_t i = 0; i < kChecksumBytes; ++i)
    packed_[bytes + i] = static_cast<std::uint8_t>(sum >> (8 * i));
  return {packed_.data(), bytes + kChecksumBytes};
}

std::uint32_t fletcher32(std::span<const std::uint8_t> bytes) {
  constexpr std::size_t kWords = 1u << 16;  // so many sums fit 64 bits by far
  std::uint64_t first = 0, second = 0;
  for (std::size_t at = 0; at < bytes.size(); at += 2 * kWords) {
    const std::size_t end = std::min(bytes.size(), at + 2 * kWords);
    for (std::size_t i = at; i < end; i += 2) {
      first += std::uint64_t{bytes[i]} << 8 | (i + 1 < end ? bytes[i + 1] : 0u);
      second += first;
    }
    first = folded(first);
    second = folded(second);
  }
  return static_cast<std::uint32_t>(second << 16 | first);
}

}  // namespace flowslide
