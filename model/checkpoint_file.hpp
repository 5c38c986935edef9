#pragma once
#include "core/files.hpp"
#include "core/hash.hpp"

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string_view>
#include <type_traits>
#include <vector>

/// Checkpoints of long runs: values and arrays as they lie in memory, after a number that stands
/// for the list of fields and before the SHA-256 of all of it. Native byte order; for the same
/// program on the same machine. docs/adr/0008-checkpoints.md
namespace flowslide {

inline constexpr double kCheckpointSeconds =
    15.0;                                         ///< least wall time between checkpoints of a run
inline constexpr double kCheckpointShare = 0.01;  ///< of the wall time, that checkpoints may take

/// Wall time from one checkpoint, which took `saved` to write, to the next [s].
constexpr double checkpoint_interval(double saved) {
  const double least = saved / kCheckpointShare;
  return least > kCheckpointSeconds ? least : kCheckpointSeconds;
}

/// Whether there is one, after what killed writers left beside it is gone. Throws FileError.
bool find_checkpoint(const std::filesystem::path& path);

/// When it returns, the checkpoint is gone from the disk, too: what it counts may go then, and not
/// before. Throws FileError.
void remove_checkpoint(const std::filesystem::path& path);

/// Throws the FileError of a checkpoint that is whole but cannot be continued.
[[noreturn]] void refuse_checkpoint(const std::filesystem::path& path, std::string_view why);

/// Replaces `path` in finish(), when all bytes are on the disk. Throws FileError.
class CheckpointWriter {
 public:
  /// @param fields changes whenever the list of fields changes
  CheckpointWriter(const std::filesystem::path& path, std::uint64_t fields);
  template <class T>
  void value(const T& x) {
    static_assert(std::is_trivially_copyable_v<T>);
    put(&x, sizeof x);
  }
  template <class T, class Allocator>
  void array(const std::vector<T, Allocator>& x) {
    static_assert(std::is_trivially_copyable_v<T>);
    value(std::uint64_t{x.size()});
    put(x.data(), x.size() * sizeof(T));
  }
  void finish();

 private:
  void put(const void* bytes, std::size_t size);
  OutputFile out_;
  Sha256 digest_;
};

/// Reads in the order of writing. Nothing is read from a file whose bytes are not those that were
/// written: the constructor throws FileError for it, and for another list of fields.
class CheckpointReader {
 public:
  CheckpointReader(std::filesystem::path path, std::uint64_t fields);
  template <class T>
  void value(T& x) {
    static_assert(std::is_trivially_copyable_v<T>);
    take(&x, sizeof x);
  }
  template <class T, class Allocator>
  void array(std::vector<T, Allocator>& x) {
    static_assert(std::is_trivially_copyable_v<T>);
    std::uint64_t size = 0;
    value(size);
    if (size > left_ / sizeof(T)) refuse("it ends within a field");
    x.resize(size);
    take(x.data(), size * sizeof(T));
  }
  /// After the last field. Throws FileError if there is more.
  void finish();
  [[noreturn]] void refuse(std::string_view why) const { refuse_checkpoint(path_, why); }

 private:
  void take(void* bytes, std::size_t size);
  [[noreturn]] void fail_to_read() const;
  std::filesystem::path path_;
  std::ifstream in_;
  std::uint64_t left_ = 0;  ///< bytes before the checksum
};

}  // namespace flowslide
