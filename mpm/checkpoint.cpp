#include "mpm/checkpoint.hpp"

#include "core/check.hpp"

#include <cstdint>
#include <fstream>

namespace flowslide::mpm {
namespace {

// Changes whenever the list of fields below changes.
constexpr std::uint64_t kMagic = 0x666c6f77636b7032;

/// One list of fields for both directions: `Archive` writes or reads each.
template <class Archive, class Sim, class Run>
void transfer_fields(Archive& a, Sim& s, Run& r) {
  a.value(r.frames);
  a.value(r.samples);
  a.value(r.next_frame);
  a.value(r.next_sample);
  a.value(r.peak_kinetic);
  a.value(r.mass_start);
  a.value(r.kinetic_start);
  a.value(r.potential_start);
  a.value(r.recoverable_start);
  a.value(r.momentum_start);
  a.value(r.first_dt);
  a.value(r.updates);
  a.array(r.recent);
  a.value(s.time);
  a.value(s.dt);
  a.value(s.step);
  a.value(s.drift);
  a.value(s.binned);
  a.value(s.last);
  a.value(s.balance);
  a.array(s.tiling.tiles);
  a.array(s.tiling.run_first);
  a.array(s.tiling.runs);
  a.array(s.contact.impulse);
  visit_arrays(s.points, [&](auto& array) { a.array(array); });
  visit_arrays(s.gone, [&](auto& array) { a.array(array); });
}

class Writer {
 public:
  explicit Writer(const std::filesystem::path& path) : out_(path, std::ios::binary) {}
  template <class T>
  void value(const T& x) {
    static_assert(std::is_trivially_copyable_v<T>);
    out_.write(reinterpret_cast<const char*>(&x), sizeof x);
  }
  template <class T>
  void array(const std::vector<T>& x) {
    value(std::uint64_t{x.size()});
    out_.write(reinterpret_cast<const char*>(x.data()),
               static_cast<std::streamsize>(x.size() * sizeof(T)));
  }
  bool close() {
    out_.close();
    return !out_.fail();
  }

 private:
  std::ofstream out_;
};

class Reader {
 public:
  explicit Reader(const std::filesystem::path& path)
      : in_(path, std::ios::binary), left_(std::filesystem::file_size(path)) {}
  template <class T>
  void value(T& x) {
    take(sizeof x);
    in_.read(reinterpret_cast<char*>(&x), sizeof x);
  }
  template <class T>
  void array(std::vector<T>& x) {
    std::uint64_t size = 0;
    value(size);
    if (size > left_ / sizeof(T)) left_ = 0, size = 0, failed_ = true;
    take(size * sizeof(T));
    x.resize(size);
    in_.read(reinterpret_cast<char*>(x.data()), static_cast<std::streamsize>(size * sizeof(T)));
  }
  [[nodiscard]] bool complete() const { return in_.good() && !failed_ && left_ == 0; }

 private:
  void take(std::uint64_t bytes) {
    failed_ = failed_ || bytes > left_;
    left_ -= std::min<std::uint64_t>(bytes, left_);
  }
  std::ifstream in_;
  std::uint64_t left_;
  bool failed_ = false;
};

}  // namespace

void write_checkpoint(const std::filesystem::path& path, const Simulation<2>& s,
                      const RunState& run) {
  std::filesystem::path partial = path;
  partial += ".partial";
  Writer out(partial);
  out.value(kMagic);
  transfer_fields(out, s, run);
  std::error_code error;
  if (out.close())
    std::filesystem::rename(partial, path, error);
  else
    error = std::make_error_code(std::errc::io_error);
  if (error)
    throw FileError(fmt::format("cannot write the checkpoint '{}' ({}) is the disk full?",
                                path.string(), error.message()));
}

void read_checkpoint(const std::filesystem::path& path, Simulation<2>& s, RunState& run) {
  const std::size_t points = s.points.size();
  std::uint64_t magic = 0;
  Reader in(path);
  in.value(magic);
  if (magic == kMagic) transfer_fields(in, s, run);
  if (magic != kMagic || !in.complete() || s.points.size() + s.gone.size() != points) {
    throw FileError(
        fmt::format("the checkpoint '{}' is damaged or of another program version (cannot be "
                    "continued) delete it to start the flow anew",
                    path.string()));
  }
}

}  // namespace flowslide::mpm
